// SPDX-License-Identifier: MIT
#include "sateen/matcap/matcap_picture.h"

#include <algorithm>

#include "sateen/io/image.h"

namespace sateen::matcap {

MatcapPicture read_matcap_picture(const std::filesystem::path& path, const std::optional<Disc>& disc) {
  const Image picture = io::read_image(path, {.most_across = kMostAcross});
  MatcapPicture result;
  if (disc) {
    const io::ImageInfo info = io::read_image_info(path);
    check_disc(*disc, info.width, info.height, path.string());
    const int box = (std::max(info.width, info.height) - 1) / kMostAcross + 1;
    result.disc = {disc->x / box, disc->y / box, disc->radius / box};
  } else {
    result.disc = find_disc(picture, path.string());
  }
  result.image = with_channels(picture, 3);
  if (picture.channels == 2 || picture.channels == 4) {
    for (int y = 0; y < picture.height; ++y) {
      for (int x = 0; x < picture.width; ++x) {
        const float alpha = picture.at(x, y, picture.channels - 1);
        if (alpha > 0) result.image.set_rgb(x, y, picture.rgb(x, y) / alpha);
      }
    }
  }
  return result;
}

}  // namespace sateen::matcap
