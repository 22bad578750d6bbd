// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include <opencv2/core.hpp>

#include "sateen/capture/turning/turning.h"

namespace sateen::capture {

/// Patches as floats, less what stands still in them (shading, the stand, the lens): that is no surface.
std::vector<cv::Mat> moving_detail(std::span<const SurfacePatch> patches);

/// The pixels of a patch's disc and the normals they show, in columns so that a block of pixels shares its
/// arithmetic.
class PatchNormals {
 public:
  static constexpr int kBlock = 64;

  /// Every `every`-th pixel.
  explicit PatchNormals(int size, int every = 1);

  int size() const { return size_; }
  /// y * size + x of each pixel; then zeros up to a whole block.
  const std::vector<int>& pixels() const { return pixels_; }
  /// Row i is the normal of pixels()[i]; those beyond the last look away from the camera.
  const Eigen::ArrayX3f& normals() const { return normals_; }

 private:
  int size_ = 0;
  std::vector<int> pixels_;
  Eigen::ArrayX3f normals_;
};

/// The rotation by which one frame differs from a picture of the surface.
struct BodyRotation {
  Vec3 rotation{0, 0, 0};  ///< radians, small, of the body: R becomes R exp(rotation)
  double correlation = 0;
  double strength = 0;  ///< of the surface's detail in the frame, 1: as strong
};

/// A picture of the surface at angle 0 with its slopes.
struct SurfacePicture {
  explicit SurfacePicture(cv::Mat picture);
  cv::Mat detail;
  cv::Mat along_x;  ///< derivative along the disc's x
  cv::Mat along_y;  ///< and y, which points up, per unit of disc
};

/// One Lucas-Kanade step for a frame turned by about `turned`, from the pixels of `normals`.
BodyRotation register_frame(const PatchNormals& normals, const SurfacePicture& surface, const cv::Mat& frame,
                            const Mat3& turned);

/// What every `every`-th frame has in common, seen at angle 0.
SurfacePicture common_surface(const PatchNormals& normals, const std::vector<cv::Mat>& images,
                              const Vec3& axis, const std::vector<double>& angles, std::size_t every = 1);

/// One round for all frames: their common surface, each one's rotation against it (register_frame), then the
/// axis (patch frame) that explains what the rotations share. Updates everything in `turning`, whose axis is
/// in the patches' frame here. A `quick` round looks at a part of the pixels and, where there are many, of
/// the frames.
class TurningRefinement {
 public:
  explicit TurningRefinement(const std::vector<cv::Mat>& images);
  void round(bool refine_angles, bool quick, Turning& turning) const;

 private:
  const std::vector<cv::Mat>& images_;
  PatchNormals all_;
  PatchNormals some_;
};

}  // namespace sateen::capture
