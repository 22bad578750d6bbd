// SPDX-License-Identifier: MIT
#include "sateen/capture/sphere_registration.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include <opencv2/imgproc.hpp>

#include "sateen/core/direction.h"
#include "sateen/core/parallel.h"

namespace sateen {
namespace {

constexpr double kReach = kPatchReach * kPatchReach * 0.96;  // of the patch's disc, squared

Mat3 turn(const Vec3& axis, double angle) {
  return Eigen::AngleAxisd(angle, axis).toRotationMatrix();
}

/// Calls body(pixel of the surface (the disc at angle 0), its normal, the frame's value there) for every
/// `every`-th pixel that a frame turned by `rotation` shows inside its own disc.
template <class Body>
void for_shown(const PatchNormals& normals, const cv::Mat& image, const Mat3& rotation, int every,
               const Body& body) {
  const Eigen::Matrix3f turned = rotation.cast<float>();
  const int size = normals.size();
  const float* pixels = image.ptr<float>(0);
  float x = 0;
  float y = 0;
  const std::span<const PatchNormals::Entry> entries = normals.entries();
  for (std::size_t i = 0; i < entries.size(); i += static_cast<std::size_t>(every)) {
    const PatchNormals::Entry& entry = entries[i];
    if (!normals.pixel(turned * entry.normal, x, y)) continue;
    const int x0 = static_cast<int>(x);
    const int y0 = static_cast<int>(y);
    const float fx = x - static_cast<float>(x0);
    const float fy = y - static_cast<float>(y0);
    const float* p = pixels + y0 * size + x0;
    const float top = p[0] + fx * (p[1] - p[0]);
    const float bottom = p[size] + fx * (p[size + 1] - p[size]);
    body(entry.index, entry.normal, top + fy * (bottom - top));
  }
}

/// A dozen sums of many small floats: added up in floats a few hundred at a time, then in doubles.
class Sums {
 public:
  using Terms = Eigen::Array<float, 12, 1>;
  void add(const Terms& terms) {
    part_ += terms;
    if (++count_ % 256 == 0) flush();
  }
  Eigen::Array<double, 12, 1> total() {
    flush();
    return total_;
  }

 private:
  void flush() {
    total_ += part_.cast<double>();
    part_.setZero();
  }
  Terms part_ = Terms::Zero();
  Eigen::Array<double, 12, 1> total_ = Eigen::Array<double, 12, 1>::Zero();
  int count_ = 0;
};

}  // namespace

std::vector<cv::Mat> moving_detail(std::span<const SurfacePatch> patches) {
  std::vector<cv::Mat> images(patches.size());
  for (std::size_t i = 0; i < patches.size(); ++i) {
    const SurfacePatch& patch = patches[i];
    cv::Mat(patch.size, patch.size, CV_8S, const_cast<std::int8_t*>(patch.detail.data()))
        .convertTo(images[i], CV_32F, 1 / 127.0);
  }
  cv::Mat mean = cv::Mat::zeros(images[0].size(), CV_32F);
  for (const cv::Mat& image : images) mean += image;
  mean /= static_cast<double>(images.size());
  for (cv::Mat& image : images) image -= mean;
  return images;
}

PatchNormals::PatchNormals(int size) : size_(size) {
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) {
      const Vec2 disc = kPatchReach * disc_of_pixel(x, y, size);
      if (disc.squaredNorm() > kReach) continue;
      entries_.push_back({y * size + x, normal_on_disc(disc).cast<float>()});
    }
  }
}

bool PatchNormals::pixel(const Vec3f& normal, float& x, float& y) const {
  if (normal.z() <= 0 || normal.head<2>().squaredNorm() > static_cast<float>(kReach)) return false;
  const float scale = static_cast<float>(size_) / static_cast<float>(2 * kPatchReach);
  const float middle = 0.5f * static_cast<float>(size_) - 0.5f;
  x = middle + normal.x() * scale;
  y = middle - normal.y() * scale;
  return true;
}

SurfacePicture::SurfacePicture(cv::Mat picture) : detail(std::move(picture)) {
  const double per_disc = detail.cols / (2 * kPatchReach);
  cv::Sobel(detail, along_x, CV_32F, 1, 0, 3, per_disc / 8);
  cv::Sobel(detail, along_y, CV_32F, 0, 1, 3, -per_disc / 8);
}

BodyRotation register_frame(const PatchNormals& normals, const SurfacePicture& surface, const cv::Mat& frame,
                            const Mat3& turned, int every) {
  // The six different entries of the normal matrix, the right side, and the correlation's parts.
  Sums all;
  const float* along_x = surface.along_x.ptr<float>(0);
  const float* along_y = surface.along_y.ptr<float>(0);
  const float* common = surface.detail.ptr<float>(0);
  for_shown(normals, frame, turned, every, [&](int at, const Vec3f& normal, float seen) {
    const float dx = along_x[at];
    const float dy = along_y[at];
    const float residual = seen - common[at];
    const float w = 1 / (1 + residual * residual * 100);
    // The frame shows what lies at the surface point turned back by a small body rotation w: T(n - w x n).
    const float a = normal.z() * dy;
    const float b = -normal.z() * dx;
    const float c = normal.y() * dx - normal.x() * dy;
    const float wa = w * a;
    const float wb = w * b;
    const float wc = w * c;
    Sums::Terms terms;
    terms << wa * a, wa * b, wa * c, wb * b, wb * c, wc * c, wa * residual, wb * residual, wc * residual,
        seen * common[at], seen * seen, common[at] * common[at];
    all.add(terms);
  });
  const Eigen::Array<double, 12, 1> sums = all.total();
  Mat3 normal_matrix;
  normal_matrix << sums[0], sums[1], sums[2], sums[1], sums[3], sums[4], sums[2], sums[4], sums[5];
  normal_matrix += Mat3::Identity() * 1e-9;
  BodyRotation result;
  result.rotation = normal_matrix.ldlt().solve(Vec3(sums[6], sums[7], sums[8]));
  result.strength = sums[9] / std::max(1e-12, sums[11]);
  result.correlation = sums[9] / std::sqrt(std::max(1e-12, sums[10] * sums[11]));
  return result;
}

SurfacePicture common_surface(const PatchNormals& normals, const std::vector<cv::Mat>& images,
                              const Vec3& axis, const std::vector<double>& angles) {
  const int size = normals.size();
  constexpr int kSlots = 4;  // partial sums, the same whatever the number of threads
  std::array<cv::Mat, kSlots> sums;
  std::array<cv::Mat, kSlots> weights;
  parallel_for(kSlots, [&](int i) {
    const auto slot = static_cast<std::size_t>(i);
    sums[slot] = cv::Mat::zeros(size, size, CV_32F);
    weights[slot] = cv::Mat::zeros(size, size, CV_32F);
    auto* sum = sums[slot].ptr<float>(0);
    auto* weight = weights[slot].ptr<float>(0);
    for (std::size_t f = slot; f < images.size(); f += kSlots) {
      for_shown(normals, images[f], turn(axis, angles[f]), 1, [&](int at, const Vec3f&, float seen) {
        sum[at] += seen;
        weight[at] += 1;
      });
    }
  });
  cv::Mat surface = sums[0] + sums[1] + sums[2] + sums[3];
  const cv::Mat weight = weights[0] + weights[1] + weights[2] + weights[3];
  cv::divide(surface, cv::max(weight, 1.0f), surface);
  return SurfacePicture(surface);
}

void refine_turning(const PatchNormals& normals, const std::vector<cv::Mat>& images, bool refine_angles,
                    int every, Turning& turning) {
  Vec3& axis = turning.axis;
  std::vector<double>& angles = turning.angles;
  const SurfacePicture surface = common_surface(normals, images, axis, angles);
  const std::size_t n = images.size();
  turning.strength.resize(n);
  turning.confidence.resize(n);
  std::vector<Vec3> rotation(n, Vec3::Zero());
  parallel_for(static_cast<int>(n), [&](int i) {
    const auto f = static_cast<std::size_t>(i);
    const BodyRotation found = register_frame(normals, surface, images[f], turn(axis, angles[f]), every);
    rotation[f] = found.rotation;
    turning.strength[f] = found.strength;
    turning.confidence[f] = found.correlation;
  });

  // Body rotation w of frame f, expressed in the camera: R w. A wrong axis a + d explains R(a + d) = R(a)
  // exp(w) with w = (R^-1 - 1) (d x a) + c plus the angle's own error along the axis; c is the surface's free
  // choice of pose.
  Vec3 e1;
  Vec3 e2;
  frame_around(axis, e1, e2);
  Mat4 normal_matrix = Mat4::Identity() * 1e-9;
  Vec4 right = Vec4::Zero();
  Eigen::Matrix<double, 3, 2> basis;
  basis << e1, e2;
  for (std::size_t f = 0; f < n; ++f) {
    const Mat3 back = turn(axis, angles[f]).transpose() - Mat3::Identity();
    Eigen::Matrix<double, 3, 4> rows;
    rows << back * axis.cross(e1), back * axis.cross(e2), e1, e2;
    const Eigen::Matrix<double, 2, 4> across = basis.transpose() * rows;
    normal_matrix += across.transpose() * across;
    right += across.transpose() * (basis.transpose() * rotation[f]);
  }
  const Vec4 solution = normal_matrix.ldlt().solve(right);
  const Vec3 tilt = solution[0] * e1 + solution[1] * e2;
  double squares = 0;
  const double first = rotation[0].dot(axis);
  for (std::size_t f = 0; f < n; ++f) {
    const double change = rotation[f].dot(axis) - first;
    if (refine_angles) angles[f] += change;
    squares += change * change;
  }
  axis = (axis + tilt).normalized();
  turning.step_error = std::sqrt(squares / static_cast<double>(n));
}

}  // namespace sateen
