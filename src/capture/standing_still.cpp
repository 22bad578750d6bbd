// SPDX-License-Identifier: MIT
#include "sateen/capture/standing_still.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "sateen/core/direction.h"

namespace sateen {

void hide_what_stands_still(const RectifyMap& map, const FirstLook& look, std::vector<SeenPoint>& points,
                            std::vector<std::string>& warnings) {
  const int size = map.size();
  const int width = look.camera.width;
  std::vector<std::size_t> still;
  double inside = 0;
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) {
      const Vec2 disc = disc_of_pixel(x, y, size);
      const Vec2 p = map.pixel(x, y) / look.factor;
      if (disc.norm() > 0.96 || p.x() < 2) continue;
      ++inside;
      // The quietest of a plus of pixels would be chance; the loudest has to be quiet.
      float loudest = 0;
      for (const auto& [u, v] : {std::pair{0, 0}, {-1, 0}, {1, 0}, {0, -1}, {0, 1}}) {
        const auto i =
            (static_cast<std::ptrdiff_t>(p.y()) + v) * width + static_cast<std::ptrdiff_t>(p.x()) + u;
        loudest = std::max(loudest, look.scouting.activity[static_cast<std::size_t>(i)]);
      }
      if (static_cast<double>(loudest) < 2 * look.scouting.noise)
        still.push_back(static_cast<std::size_t>(y * size + x));
    }
  }
  const double share = static_cast<double>(still.size()) / std::max(1.0, inside);
  if (share < 0.003) return;
  if (share > 0.25) {
    warnings.push_back(fmt::format(
        "{:.0f} % of the sphere hardly changes as it turns: it is plain there, very dark, or covered",
        100 * share));
    return;
  }
  for (const std::size_t i : still) points[i].visible = false;
  warnings.push_back(
      fmt::format("{:.1f} % of the sphere stands still, as behind a stand, and was filled from its "
                  "neighbours: keep the front clear",
                  100 * share));
}

}  // namespace sateen
