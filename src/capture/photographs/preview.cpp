// SPDX-License-Identifier: MIT
#include "sateen/capture/photographs/preview.h"

#include "sateen/core/parallel.h"

namespace sateen::capture {

Image preview_of(const Photograph& frame) {
  const int factor = (frame.width() + 959) / 960;
  Image preview(frame.width() / factor, frame.height() / factor, 3);
  parallel_for(preview.height, [&](int y) {
    for (int x = 0; x < preview.width; ++x) {
      Vec3f sum(0, 0, 0);
      for (int v = y * factor; v < (y + 1) * factor; ++v) {
        for (int u = x * factor; u < (x + 1) * factor; ++u) sum += frame.rgb(u, v);
      }
      preview.set_rgb(x, y, sum / static_cast<float>(factor * factor));
    }
  });
  return preview;
}

}  // namespace sateen::capture
