// SPDX-License-Identifier: MIT
#include "sateen/capture/turning/surface_patch.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <opencv2/imgproc.hpp>

#include "sateen/core/direction.h"

namespace sateen::capture {
namespace {

/// Bilinear light, clamped to the edge.
float light_at(const GreyPicture& picture, const Vec2f& pixel) {
  const float x = std::clamp(pixel.x() - 0.5f, 0.0f, static_cast<float>(picture.width) - 1.001f);
  const float y = std::clamp(pixel.y() - 0.5f, 0.0f, static_cast<float>(picture.height) - 1.001f);
  const int x0 = static_cast<int>(x);
  const int y0 = static_cast<int>(y);
  const float fx = x - static_cast<float>(x0);
  const float fy = y - static_cast<float>(y0);
  const std::uint8_t* p = &picture.codes[pixel_index(x0, y0, picture.width)];
  const std::uint8_t* q = p + picture.width;
  const auto& light = kLightOfCode<float>;
  const float top = light[p[0]] + fx * (light[p[1]] - light[p[0]]);
  const float bottom = light[q[0]] + fx * (light[q[1]] - light[q[0]]);
  return top + fy * (bottom - top);
}

}  // namespace

PatchMap::PatchMap(const Camera& camera, const SphereView& mean, const Mat3& axes, int size, StillMask still)
    : size_(size), centre_(mean.centre_pixel(camera)), still_(std::move(still)) {
  still_.factor = 1;  // places are in grey pixels, as the mask is
  const double radius = mean.radius_pixel(camera);
  const Mat3 to_view = axes.transpose();
  const SphereView right = sphere_at(camera, centre_ + Vec2(1, 0), radius);
  const SphereView down = sphere_at(camera, centre_ + Vec2(0, 1), radius);
  inside_ = cv::Mat::zeros(size, size, CV_32F);
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) {
      const Vec2 disc = kPatchReach * disc_of_pixel(x, y, size);
      if (disc.norm() > kPatchReach) continue;
      const Vec3 normal = to_view * normal_on_disc(disc);
      const Vec2 at = camera.project(mean.centre + normal);
      const Vec2 along_x = camera.project(right.centre + normal) - at;
      const Vec2 along_y = camera.project(down.centre + normal) - at;
      places_.push_back({y * size + x, at.cast<float>(), along_x.cast<float>(), along_y.cast<float>()});
      inside_.at<float>(y, x) = 1;
    }
  }
  share_ = around(inside_);
}

cv::Mat PatchMap::around(const cv::Mat& light) const {
  cv::Mat mean;
  cv::GaussianBlur(light, mean, {}, size_ / 120.0);
  return mean;
}

SurfacePatch PatchMap::patch(const GreyPicture& frame, const Vec2& centre) const {
  const Vec2f shift = (centre - centre_).cast<float>();
  cv::Mat light = cv::Mat::zeros(size_, size_, CV_32F);
  auto* lights = light.ptr<float>(0);
  const bool masked = still_.width > 0;
  cv::Mat shown = masked ? inside_.clone() : inside_;
  for (const Place& place : places_) {
    const Vec2f p = place.at + shift.x() * place.along_x + shift.y() * place.along_y;
    if (masked && still_.hides(p.x(), p.y())) {
      shown.ptr<float>(0)[place.index] = 0;
    } else {
      lights[place.index] = light_at(frame, p);
    }
  }
  const cv::Mat share = masked ? around(shown) : share_;
  const cv::Mat blurred = around(light);
  const auto pixels = static_cast<Eigen::Index>(size_) * size_;
  const auto row_of = [&](const cv::Mat& picture) {
    return Eigen::Map<const Eigen::ArrayXf>(picture.ptr<float>(0), pixels);
  };
  // In the dark the detail is noise: the floor keeps it small. Elsewhere there is no light.
  const Eigen::ArrayXf mean = row_of(blurred) / row_of(share).max(1e-6f);
  const Eigen::ArrayXf detail =
      row_of(shown) * ((row_of(light) - mean) / (mean + 0.01f)).max(-1.0f).min(1.0f);
  SurfacePatch patch;
  patch.size = size_;
  patch.detail.resize(static_cast<std::size_t>(pixels));
  Eigen::Map<Eigen::Array<std::int8_t, Eigen::Dynamic, 1>>(patch.detail.data(), pixels) =
      ((detail * 127 + 127.5f).cast<int>() - 127).cast<std::int8_t>();
  patch.sharpness = std::sqrt(static_cast<double>(detail.square().sum()) /
                              std::max(1.0, static_cast<double>(places_.size())));
  return patch;
}

}  // namespace sateen::capture
