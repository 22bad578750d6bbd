// SPDX-License-Identifier: MIT
#include "sateen/capture/sphere/lens.h"

namespace sateen::capture {

const char* words(FocalSource source) {
  switch (source) {
    case FocalSource::calibration:
      return "calibration";
    case FocalSource::field_of_view:
      return "field of view given";
    case FocalSource::lens_and_sensor:
      return "focal length and sensor given";
    case FocalSource::exif_and_sensor:
      return "EXIF focal length, sensor given";
    case FocalSource::exif_35mm:
      return "EXIF 35 mm equivalent";
    case FocalSource::outline:
      return "estimated from the sphere's outline";
    case FocalSource::assumed:
      break;
  }
  return "assumed";
}

}  // namespace sateen::capture
