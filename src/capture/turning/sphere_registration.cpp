// SPDX-License-Identifier: MIT
#include "sateen/capture/turning/sphere_registration.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include <opencv2/imgproc.hpp>

#include "sateen/core/direction.h"
#include "sateen/core/parallel.h"

namespace sateen::capture {
namespace {

constexpr double kReach = kPatchReach * kPatchReach * 0.96;  // of the patch's disc, squared

Mat3 turn(const Vec3& axis, double angle) {
  return Eigen::AngleAxisd(angle, axis).toRotationMatrix();
}

constexpr int kBlock = PatchNormals::kBlock;
using Block = Eigen::Array<float, kBlock, 1>;

/// What a frame shows of a block of surface pixels.
struct ShownBlock {
  std::span<const int> pixel;  // of the surface (the disc at angle 0)
  Eigen::Array<float, kBlock, 3> normal;
  Block inside;  // 1: the frame shows it inside its own disc; 0: it does not
  Block seen;    // the frame's value; 0 where it is not inside
};

/// Calls body(ShownBlock) for all of `normals`, as a frame turned by `rotation` shows them.
template <class Body>
void for_shown(const PatchNormals& normals, const cv::Mat& image, const Mat3& rotation, const Body& body) {
  const Eigen::Matrix3f turned = rotation.cast<float>();
  const int size = normals.size();
  const auto scale = static_cast<float>(size / (2 * kPatchReach));
  const float middle = 0.5f * static_cast<float>(size) - 0.5f;
  const float* pixels = image.ptr<float>(0);
  ShownBlock block;
  for (Eigen::Index first = 0; first < normals.normals().rows(); first += kBlock) {
    block.pixel = std::span(normals.pixels()).subspan(static_cast<std::size_t>(first), kBlock);
    block.normal = normals.normals().middleRows<kBlock>(first);
    const auto along = [&](int axis) -> Block {
      return turned(axis, 0) * block.normal.col(0) + turned(axis, 1) * block.normal.col(1) +
             turned(axis, 2) * block.normal.col(2);
    };
    const Block nx = along(0);
    const Block ny = along(1);
    block.inside =
        (along(2) > 0 && nx.square() + ny.square() <= static_cast<float>(kReach)).template cast<float>();
    const Block x = block.inside * (middle + scale * nx);
    const Block y = block.inside * (middle - scale * ny);
    for (int i = 0; i < kBlock; ++i) {
      const int x0 = static_cast<int>(x[i]);
      const int y0 = static_cast<int>(y[i]);
      const float fx = x[i] - static_cast<float>(x0);
      const float fy = y[i] - static_cast<float>(y0);
      const float* p = pixels + y0 * size + x0;
      const float top = p[0] + fx * (p[1] - p[0]);
      const float bottom = p[size] + fx * (p[size + 1] - p[size]);
      block.seen[i] = block.inside[i] * (top + fy * (bottom - top));
    }
    body(block);
  }
}

/// What `picture` has at the block's pixels that are inside; 0 at the others.
Block values_at(const cv::Mat& picture, const ShownBlock& block) {
  const float* values = picture.ptr<float>(0);
  Block result;
  for (int i = 0; i < kBlock; ++i) result[i] = values[block.pixel[static_cast<std::size_t>(i)]];
  return result * block.inside;
}

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

PatchNormals::PatchNormals(int size, int every) : size_(size) {
  std::vector<Vec3f> normals;
  int count = 0;
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) {
      const Vec2 disc = kPatchReach * disc_of_pixel(x, y, size);
      if (disc.squaredNorm() > kReach || count++ % every != 0) continue;
      pixels_.push_back(y * size + x);
      normals.emplace_back(normal_on_disc(disc).cast<float>());
    }
  }
  const std::size_t padded = (normals.size() + kBlock - 1) / kBlock * kBlock;
  pixels_.resize(padded, 0);
  normals.resize(padded, Vec3f(0, 0, -1));
  normals_.resize(static_cast<Eigen::Index>(padded), 3);
  for (std::size_t i = 0; i < padded; ++i) normals_.row(static_cast<Eigen::Index>(i)) = normals[i].array();
}

SurfacePicture::SurfacePicture(cv::Mat picture) : detail(std::move(picture)) {
  const double per_disc = detail.cols / (2 * kPatchReach);
  cv::Sobel(detail, along_x, CV_32F, 1, 0, 3, per_disc / 8);
  cv::Sobel(detail, along_y, CV_32F, 0, 1, 3, -per_disc / 8);
}

BodyRotation register_frame(const PatchNormals& normals, const SurfacePicture& surface, const cv::Mat& frame,
                            const Mat3& turned) {
  // The six different entries of the normal matrix, the right side, and the correlation's parts: in floats
  // over a block, in doubles over all.
  Eigen::Array<double, 12, 1> sums = Eigen::Array<double, 12, 1>::Zero();
  for_shown(normals, frame, turned, [&](const ShownBlock& block) {
    const Block dx = values_at(surface.along_x, block);
    const Block dy = values_at(surface.along_y, block);
    const Block common = values_at(surface.detail, block);
    const Block residual = block.seen - common;
    const Block w = (1 + 100 * residual.square()).inverse();
    // The frame shows what lies at the surface point turned back by a small body rotation w: T(n - w x n).
    const Block a = block.normal.col(2) * dy;
    const Block b = -block.normal.col(2) * dx;
    const Block c = block.normal.col(1) * dx - block.normal.col(0) * dy;
    const Block wa = w * a;
    const Block wb = w * b;
    const Block wc = w * c;
    Eigen::Array<float, 12, 1> part;
    part << (wa * a).sum(), (wa * b).sum(), (wa * c).sum(), (wb * b).sum(), (wb * c).sum(), (wc * c).sum(),
        (wa * residual).sum(), (wb * residual).sum(), (wc * residual).sum(), (block.seen * common).sum(),
        block.seen.square().sum(), common.square().sum();
    sums += part.cast<double>();
  });
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
                              const Vec3& axis, const std::vector<double>& angles, std::size_t every) {
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
    for (std::size_t f = slot * every; f < images.size(); f += kSlots * every) {
      for_shown(normals, images[f], turn(axis, angles[f]), [&](const ShownBlock& block) {
        for (int k = 0; k < kBlock; ++k) {
          const int at = block.pixel[static_cast<std::size_t>(k)];
          sum[at] += block.seen[k];
          weight[at] += block.inside[k];
        }
      });
    }
  });
  cv::Mat surface = sums[0] + sums[1] + sums[2] + sums[3];
  const cv::Mat weight = weights[0] + weights[1] + weights[2] + weights[3];
  cv::divide(surface, cv::max(weight, 1.0f), surface);
  return SurfacePicture(surface);
}

namespace {

constexpr int kQuickEvery = 2;     // pixel
constexpr std::size_t kMany = 96;  // frames of which a part shows the surface as well

}  // namespace

TurningRefinement::TurningRefinement(const std::vector<cv::Mat>& images)
    : images_(images), all_(images[0].cols), some_(images[0].cols, kQuickEvery) {}

void TurningRefinement::round(bool refine_angles, bool quick, Turning& turning) const {
  Vec3& axis = turning.axis;
  std::vector<double>& angles = turning.angles;
  const std::size_t n = images_.size();
  const SurfacePicture surface = common_surface(all_, images_, axis, angles, quick && n >= kMany ? 2 : 1);
  turning.strength.resize(n);
  turning.confidence.resize(n);
  std::vector<Vec3> rotation(n, Vec3::Zero());
  parallel_for(static_cast<int>(n), [&](int i) {
    const auto f = static_cast<std::size_t>(i);
    const BodyRotation found =
        register_frame(quick ? some_ : all_, surface, images_[f], turn(axis, angles[f]));
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
  if (refine_angles) {
    const double first = rotation[0].dot(axis);
    for (std::size_t f = 0; f < n; ++f) angles[f] += rotation[f].dot(axis) - first;
  }
  axis = (axis + tilt).normalized();
}

}  // namespace sateen::capture
