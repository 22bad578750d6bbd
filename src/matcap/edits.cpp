// SPDX-License-Identifier: MIT
#include "sateen/matcap/edits.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "sateen/core/colour.h"
#include "sateen/core/direction.h"
#include "sateen/core/error.h"
#include "sateen/io/image.h"
#include "sateen/matcap/decomposition_file.h"
#include "sateen/matcap/sharpen.h"
#include "sateen/matcap/sphere_blur.h"
#include "sateen/matcap/warp.h"

namespace sateen::matcap {
namespace {

constexpr double kHighlightBlur = 0.01;  // radians^2: what the main highlight must stand out in
constexpr double kSharpest = 1e-5;       // radians^2

/// Something painted, in the light's own frame; drawn at the end, when the filter's final variance is known.
struct Painted {
  Part part;
  LightPlace place;
  std::variant<Footprint, Bitmap> light;
  Vec3 color;
};

class Replay {
 public:
  explicit Replay(MatcapDecomposition matcap) : state_(unedited(std::move(matcap))) {
    for (const Part part : kParts) variance_[index(part)] = state_.matcap[part].variance;
  }

  void operator()(const Turn& edit) { state_.light = rotation_xyz(edit.angles) * state_.light; }

  void operator()(const Align& edit) {
    const Vec3 now = state_.light * main_highlight(state_.matcap);
    const Vec3 then = warp(normal_on_disc(edit.to), slope_of_variance(variance_[index(Part::high)]));
    state_.light = rotation_between(now, then) * state_.light;
  }

  void operator()(const Paint& edit) {
    painted_.push_back({edit.part, place(edit.part, edit.at, edit.turn), edit.footprint, edit.color});
  }

  void operator()(const Bitmap& edit) {
    painted_.push_back({edit.part, place(edit.part, edit.at, edit.turn), edit, edit.color});
  }

  void operator()(const Roughness& edit) {
    double& variance = variance_[index(edit.part)];
    variance = edit.absolute ? edit.variance : variance + edit.variance;
    if (!(variance >= kSharpest)) {
      throw Error(fmt::format("the {} part's filter would get a variance of {:.4g}; it must stay above {}",
                              name_of(edit.part), variance, kSharpest));
    }
    variance = std::min(variance, kFlattest);
  }

  void operator()(const Recolor& edit) {
    Vec3& color = state_.look(edit.part).base_color;
    Vec3 hsv = rgb_to_hsv(color);
    hsv = {wrap(hsv.x() + edit.hue), std::clamp(hsv.y() * edit.saturation, 0.0, 1.0), hsv.z() * edit.value};
    color = hsv_to_rgb(hsv);
  }

  void operator()(const Intensity& edit) { state_.look(edit.part).intensity *= edit.factor; }

  void operator()(const SetSilhouette& edit) { state_.look(edit.part).silhouette = edit.silhouette; }

  void operator()(const Mix& edit) {
    MatcapDecomposition other = read_matcap(edit.from);
    if (other.space != state_.matcap.space) {
      throw Error(fmt::format(
          "{}: its parts add up in another space (display or linear) than those of the MatCap it is "
          "mixed with",
          edit.from.string()));
    }
    MatcapPart& part = state_.matcap[edit.part];
    part = std::move(other[edit.part]);
    variance_[index(edit.part)] = part.variance;
    state_.look(edit.part) = PartLook{part.base_color, 1, std::nullopt};
    std::erase_if(painted_, [&](const Painted& p) { return p.part == edit.part; });
  }

  EditedMatcap finish() {
    give_one_size();
    for (const Part part : kParts) finish(part);
    return std::move(state_);
  }

 private:
  static std::size_t index(Part part) { return static_cast<std::size_t>(part); }

  LightPlace place(Part part, const Vec2& at, double turn) const {
    const Vec3 seen = warp(normal_on_disc(at), slope_of_variance(variance_[index(part)]));
    const Vec3 up = Eigen::AngleAxisd(turn, seen) * Vec3::UnitY();
    return {state_.light.transpose() * seen, state_.light.transpose() * up};
  }

  /// Of mixed MatCaps the smaller map gets the larger one's size: one texture holds both.
  void give_one_size() {
    int size = 0;
    for (const MatcapPart& part : state_.matcap.parts) size = std::max(size, part.map.levels.front().size());
    for (MatcapPart& part : state_.matcap.parts) {
      const SphereMap& map = part.map.levels.front();
      if (map.size() != size) part.map = prefilter(blurred(map, 0, size));
    }
  }

  void finish(Part which) {
    MatcapPart& part = state_.matcap[which];
    const double variance = variance_[index(which)];
    const double change = variance - part.variance;
    SphereMap map;
    if (change > 0) map = blurred(part.map, change);
    if (change < 0) map = sharpened(part.map.levels.front(), -change);
    part.variance = variance;
    for (const Painted& painted : painted_) {
      if (painted.part != which) continue;
      if (map.front.empty()) map = part.map.levels.front();
      if (const auto* footprint = std::get_if<Footprint>(&painted.light)) {
        paint(map, painted.place, *footprint, painted.color, variance);
      } else {
        const auto& bitmap = std::get<Bitmap>(painted.light);
        const Image picture = to_add_up_space(io::read_image(bitmap.file), state_.matcap.space);
        paint(map, painted.place, BitmapLight(picture, bitmap.width, variance), painted.color);
      }
    }
    if (!map.front.empty()) part.map = prefilter(std::move(map));
  }

  EditedMatcap state_;
  std::array<double, 2> variance_{};
  std::vector<Painted> painted_;
};

}  // namespace

Vec3 main_highlight(const MatcapDecomposition& matcap) {
  const PrefilteredMap& map = matcap[Part::high].map;
  const auto level = static_cast<std::size_t>(std::ceil(level_of_variance(map.variances, kHighlightBlur)));
  const SphereMap& blurry = map.levels[level];
  Vec3 brightest = Vec3::UnitZ();
  double most = -1;
  for (int y = 0; y < blurry.size(); ++y) {
    for (int x = 0; x < blurry.size(); ++x) {
      for (const bool back : {false, true}) {
        const double l = luminance((back ? blurry.back : blurry.front).rgb(x, y).cast<double>());
        if (l > most) {
          most = l;
          brightest = direction_of_texel(x, y, blurry.size(), back);
        }
      }
    }
  }
  return brightest;
}

EditedMatcap apply_edits(MatcapDecomposition matcap, const std::vector<Edit>& edits) {
  if (!edits.empty()) matcap.kept = {};  // as the light and the material were: they go with them
  Replay replay(std::move(matcap));
  for (const Edit& edit : edits) std::visit(replay, edit);
  return replay.finish();
}

}  // namespace sateen::matcap
