// SPDX-License-Identifier: MIT
#include "sateen/capture/turning.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <complex>

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "sateen/core/direction.h"
#include "sateen/core/parallel.h"

namespace sateen {
namespace {

constexpr int kRings = 40;
constexpr int kBins = 720;  // angles of a polar picture
constexpr double kInnerRing = 0.1;

float light_of(std::uint8_t code) {
  return static_cast<float>(code) * static_cast<float>(code) * (1 / (255.0f * 255.0f));
}

/// Bilinear sample of a square float picture, clamped.
float sample(const cv::Mat& image, double x, double y) {
  const double cx = std::clamp(x - 0.5, 0.0, image.cols - 1.001);
  const double cy = std::clamp(y - 0.5, 0.0, image.rows - 1.001);
  const int x0 = static_cast<int>(cx);
  const int y0 = static_cast<int>(cy);
  const auto fx = static_cast<float>(cx - x0);
  const auto fy = static_cast<float>(cy - y0);
  const float* a = image.ptr<float>(y0) + x0;
  const float* b = image.ptr<float>(y0 + 1) + x0;
  const float top = a[0] + fx * (a[1] - a[0]);
  const float bottom = b[0] + fx * (b[1] - b[0]);
  return top + fy * (bottom - top);
}

cv::Mat as_floats(const SurfacePatch& patch) {
  cv::Mat image(patch.size, patch.size, CV_32F);
  for (int y = 0; y < patch.size; ++y) {
    for (int x = 0; x < patch.size; ++x) {
      image.at<float>(y, x) =
          static_cast<float>(patch.detail[static_cast<std::size_t>(y * patch.size + x)]) / 127.0f;
    }
  }
  return image;
}

/// What stands still in the patches (shading, the stand, the lens) is no surface.
std::vector<cv::Mat> moving_detail(std::span<const SurfacePatch> patches) {
  std::vector<cv::Mat> images(patches.size());
  for (std::size_t i = 0; i < patches.size(); ++i) images[i] = as_floats(patches[i]);
  cv::Mat mean = cv::Mat::zeros(images[0].size(), CV_32F);
  for (const cv::Mat& image : images) mean += image;
  mean /= static_cast<double>(images.size());
  for (cv::Mat& image : images) image -= mean;
  return images;
}

/// Rows: rings from the middle outwards, each scaled by the square root of its length, zero mean; columns:
/// angles counter-clockwise.
cv::Mat polar(const cv::Mat& image) {
  cv::Mat result(kRings, kBins, CV_32F);
  for (int r = 0; r < kRings; ++r) {
    const double radius = kInnerRing + (0.97 - kInnerRing) * (r + 0.5) / kRings;
    double sum = 0;
    for (int a = 0; a < kBins; ++a) {
      const double angle = 2 * kPi * a / kBins;
      const Vec2 at = pixel_of_disc(radius * Vec2(std::cos(angle), std::sin(angle)), image.cols);
      result.at<float>(r, a) = sample(image, at.x(), at.y());
      sum += static_cast<double>(result.at<float>(r, a));
    }
    const auto mean = static_cast<float>(sum / kBins);
    for (int a = 0; a < kBins; ++a) {
      result.at<float>(r, a) = (result.at<float>(r, a) - mean) * static_cast<float>(std::sqrt(radius));
    }
  }
  return result;
}

cv::Mat spectrum(const cv::Mat& rows) {
  cv::Mat result;
  cv::dft(rows, result, cv::DFT_ROWS | cv::DFT_COMPLEX_OUTPUT);
  return result;
}

struct Peak {
  double angle = 0;  // by which `turned` is ahead of `still`, radians
  double height = 0;
};

/// The turn at which two polar pictures, given by their spectra, agree best, and their correlation there.
Peak correlate(const cv::Mat& turned, const cv::Mat& still) {
  cv::Mat product;
  cv::mulSpectrums(turned, still, product, cv::DFT_ROWS, true);
  cv::Mat sum;
  cv::reduce(product, sum, 0, cv::REDUCE_SUM);
  cv::Mat score;
  cv::dft(sum, score, cv::DFT_INVERSE | cv::DFT_ROWS | cv::DFT_REAL_OUTPUT);
  const float* s = score.ptr<float>(0);
  const auto best = static_cast<int>(std::max_element(s, s + kBins) - s);
  const double left = static_cast<double>(s[(best + kBins - 1) % kBins]);
  const double middle = static_cast<double>(s[best]);
  const double right = static_cast<double>(s[(best + 1) % kBins]);
  const double curve = left - 2 * middle + right;
  const double offset = curve < 0 ? 0.5 * (left - right) / curve : 0;
  Peak peak;
  peak.angle = 2 * kPi * (best + offset) / kBins;
  const double norms = cv::norm(turned) * cv::norm(still);
  // Parseval: the inverse transform here is unscaled, as the norms of the spectra are.
  peak.height = norms > 0 ? middle / norms : 0;
  return peak;
}

/// Adds a spectrum turned back by `angle`: a shift is a phase for each frequency.
void add_turned_back(cv::Mat& sum, const cv::Mat& spectrum, double angle, double sign) {
  std::vector<std::complex<float>> phase(kBins);
  for (int f = 0; f < kBins; ++f) {
    const int frequency = f <= kBins / 2 ? f : f - kBins;
    phase[static_cast<std::size_t>(f)] =
        std::polar(static_cast<float>(sign), static_cast<float>(frequency * angle));
  }
  for (int r = 0; r < kRings; ++r) {
    const auto* in = spectrum.ptr<std::complex<float>>(r);
    auto* out = sum.ptr<std::complex<float>>(r);
    for (int f = 0; f < kBins; ++f) out[f] += in[f] * phase[static_cast<std::size_t>(f)];
  }
}

/// Angles about the disc's middle: each frame against the surface the frames before it have built, then twice
/// more against all others.
void register_about_middle(const std::vector<cv::Mat>& images, Turning& turning) {
  const std::size_t n = images.size();
  std::vector<cv::Mat> spectra(n);
  parallel_for(static_cast<int>(n), [&](int i) {
    spectra[static_cast<std::size_t>(i)] = spectrum(polar(images[static_cast<std::size_t>(i)]));
  });
  turning.angles.assign(n, 0);
  turning.confidence.assign(n, 0);
  cv::Mat surface = spectra[0].clone();
  for (std::size_t i = 1; i < n; ++i) {
    turning.angles[i] = correlate(spectra[i], surface).angle;
    add_turned_back(surface, spectra[i], turning.angles[i], 1);
  }
  for (int round = 0; round < 2; ++round) {
    std::vector<Peak> peaks(n);
    parallel_for(static_cast<int>(n), [&](int f) {
      const auto i = static_cast<std::size_t>(f);
      cv::Mat others = surface.clone();
      add_turned_back(others, spectra[i], turning.angles[i], -1);
      peaks[i] = correlate(spectra[i], others);
    });
    surface.setTo(0);
    for (std::size_t i = 0; i < n; ++i) {
      turning.angles[i] = peaks[i].angle;
      turning.confidence[i] = peaks[i].height;
      add_turned_back(surface, spectra[i], peaks[i].angle, 1);
    }
  }
  // Correlation of unrelated surfaces: the peak of kBins tries among about that many times kRings / 4 free
  // values.
  turning.confidence_floor = 3.3 / std::sqrt(kBins / 3.0 * kRings / 2.0);
}

/// Rotation about the patch frame's `axis` by `angle`.
Mat3 turn(const Vec3& axis, double angle) {
  return Eigen::AngleAxisd(angle, axis).toRotationMatrix();
}

struct Surface {
  cv::Mat sum;
  cv::Mat weight;
};

/// The pixels of a patch's disc and the normals they show, made once.
struct DiscNormals {
  struct Entry {
    int index;
    Vec3f normal;
  };
  int size = 0;
  std::vector<Entry> entries;

  explicit DiscNormals(int size_) : size(size_) {
    for (int y = 0; y < size; ++y) {
      for (int x = 0; x < size; ++x) {
        const Vec2 disc = kPatchReach * disc_of_pixel(x, y, size);
        const double r2 = disc.squaredNorm();
        if (r2 > kPatchReach * kPatchReach * 0.96) continue;
        entries.push_back({y * size + x, Vec3(disc.x(), disc.y(), std::sqrt(1 - r2)).cast<float>()});
      }
    }
  }
};

/// Calls body(pixel of the surface (the disc at angle 0), its normal, the frame's value there) for every
/// pixel that a frame turned by `rotation` shows inside its own disc.
template <class Body>
void for_shown(const DiscNormals& disc, const cv::Mat& image, const Mat3& rotation, Body body) {
  const Eigen::Matrix3f turned = rotation.cast<float>();
  const auto scale = static_cast<float>(disc.size / (2 * kPatchReach));
  const float middle = 0.5f * static_cast<float>(disc.size) - 0.5f;
  constexpr auto kReach = static_cast<float>(kPatchReach * kPatchReach * 0.96);
  const float* pixels = image.ptr<float>(0);
  for (const DiscNormals::Entry& entry : disc.entries) {
    const Vec3f seen = turned * entry.normal;
    if (seen.head<2>().squaredNorm() > kReach || seen.z() <= 0) continue;
    const float x = middle + seen.x() * scale;
    const float y = middle - seen.y() * scale;
    const int x0 = static_cast<int>(x);
    const int y0 = static_cast<int>(y);
    const float fx = x - static_cast<float>(x0);
    const float fy = y - static_cast<float>(y0);
    const float* p = pixels + y0 * disc.size + x0;
    const float top = p[0] + fx * (p[1] - p[0]);
    const float bottom = p[disc.size] + fx * (p[disc.size + 1] - p[disc.size]);
    body(entry.index, entry.normal, top + fy * (bottom - top));
  }
}

/// One round of Lucas-Kanade: the surface from all frames, then each frame's rotation vector against it, then
/// what of it is the axis.
double refine(const std::vector<cv::Mat>& images, Vec3& axis, std::vector<double>& angles, bool refine_angles,
              std::vector<double>& confidence, std::vector<double>& strength) {
  const int size = images[0].cols;
  const DiscNormals disc(size);
  const std::size_t n = images.size();
  constexpr int kSlots = 4;  // partial sums, the same whatever the number of threads
  std::vector<Surface> slots(kSlots);
  parallel_for(kSlots, [&](int slot) {
    Surface& surface = slots[static_cast<std::size_t>(slot)];
    surface.sum = cv::Mat::zeros(size, size, CV_32F);
    surface.weight = cv::Mat::zeros(size, size, CV_32F);
    for (std::size_t f = static_cast<std::size_t>(slot); f < n; f += kSlots) {
      float* sum = surface.sum.ptr<float>(0);
      float* weight = surface.weight.ptr<float>(0);
      for_shown(disc, images[f], turn(axis, angles[f]), [&](int at, const Vec3f&, float seen) {
        sum[at] += seen;
        weight[at] += 1;
      });
    }
  });
  cv::Mat surface = slots[0].sum + slots[1].sum + slots[2].sum + slots[3].sum;
  cv::Mat weight = slots[0].weight + slots[1].weight + slots[2].weight + slots[3].weight;
  cv::divide(surface, cv::max(weight, 1.0f), surface);
  cv::Mat gx;
  cv::Mat gy;
  // Derivatives along the disc's x and y (up) per unit of disc.
  const double per_disc = size / (2 * kPatchReach);
  cv::Sobel(surface, gx, CV_32F, 1, 0, 3, per_disc / 8);
  cv::Sobel(surface, gy, CV_32F, 0, 1, 3, -per_disc / 8);

  std::vector<Vec3> rotation(n, Vec3::Zero());
  parallel_for(static_cast<int>(n), [&](int i) {
    const auto f = static_cast<std::size_t>(i);
    // Sums of the six different entries of the normal matrix, the right side, and the correlation's parts.
    std::array<double, 12> sums{};
    const float* along_x = gx.ptr<float>(0);
    const float* along_y = gy.ptr<float>(0);
    const float* common = surface.ptr<float>(0);
    for_shown(disc, images[f], turn(axis, angles[f]), [&](int at, const Vec3f& normal, float seen) {
      const float dx = along_x[at];
      const float dy = along_y[at];
      const float residual = seen - common[at];
      const float w = 1 / (1 + residual * residual * 100);
      // The frame shows what lies at the surface point turned back by a small body rotation w: T(n - w x n).
      const float a = normal.z() * dy;
      const float b = -normal.z() * dx;
      const float c = normal.y() * dx - normal.x() * dy;
      sums[0] += static_cast<double>(w * a * a);
      sums[1] += static_cast<double>(w * a * b);
      sums[2] += static_cast<double>(w * a * c);
      sums[3] += static_cast<double>(w * b * b);
      sums[4] += static_cast<double>(w * b * c);
      sums[5] += static_cast<double>(w * c * c);
      sums[6] += static_cast<double>(w * a * residual);
      sums[7] += static_cast<double>(w * b * residual);
      sums[8] += static_cast<double>(w * c * residual);
      sums[9] += static_cast<double>(seen * common[at]);
      sums[10] += static_cast<double>(seen * seen);
      sums[11] += static_cast<double>(common[at] * common[at]);
    });
    Mat3 normal_matrix;
    normal_matrix << sums[0], sums[1], sums[2], sums[1], sums[3], sums[4], sums[2], sums[4], sums[5];
    normal_matrix += Mat3::Identity() * 1e-9;
    const Vec3 right(sums[6], sums[7], sums[8]);
    rotation[f] = normal_matrix.ldlt().solve(right);
    strength[f] = sums[9] / std::max(1e-12, sums[11]);
    confidence[f] = sums[9] / std::sqrt(std::max(1e-12, sums[10] * sums[11]));
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
  return std::sqrt(squares / static_cast<double>(n));
}

void refine_all(const std::vector<cv::Mat>& images, const Mat3& axes, bool refine_angles, Turning& turning) {
  Vec3 axis = axes * turning.axis;
  turning.strength.assign(images.size(), 0);
  for (int round = 0; round < 3; ++round) {
    turning.step_error =
        refine(images, axis, turning.angles, refine_angles, turning.confidence, turning.strength);
  }
  turning.axis = axes.transpose() * axis;
  const double first = turning.angles[0];
  for (double& angle : turning.angles) angle = wrap(angle - first, 2 * kPi);
}

}  // namespace

SurfacePatch surface_patch(const GreyPicture& frame, const Camera& camera, const SphereView& sphere,
                           const Mat3& axes, int size) {
  cv::Mat light = cv::Mat::zeros(size, size, CV_32F);
  cv::Mat inside = cv::Mat::zeros(size, size, CV_32F);
  const Mat3 to_view = axes.transpose();
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) {
      const Vec2 disc = kPatchReach * disc_of_pixel(x, y, size);
      const double r2 = disc.squaredNorm();
      if (r2 > kPatchReach * kPatchReach) continue;
      const Vec3 normal = to_view * Vec3(disc.x(), disc.y(), std::sqrt(1 - r2));
      const Vec2 at = camera.project(sphere.centre + normal);
      const double cx = std::clamp(at.x() - 0.5, 0.0, frame.width - 1.001);
      const double cy = std::clamp(at.y() - 0.5, 0.0, frame.height - 1.001);
      const int x0 = static_cast<int>(cx);
      const int y0 = static_cast<int>(cy);
      const auto fx = static_cast<float>(cx - x0);
      const auto fy = static_cast<float>(cy - y0);
      const float top = light_of(frame.at(x0, y0)) * (1 - fx) + light_of(frame.at(x0 + 1, y0)) * fx;
      const float bottom =
          light_of(frame.at(x0, y0 + 1)) * (1 - fx) + light_of(frame.at(x0 + 1, y0 + 1)) * fx;
      light.at<float>(y, x) = top + fy * (bottom - top);
      inside.at<float>(y, x) = 1;
    }
  }
  cv::Mat around;
  cv::Mat share;
  const double sigma = size / 120.0;
  cv::GaussianBlur(light, around, {}, sigma);
  cv::GaussianBlur(inside, share, {}, sigma);
  SurfacePatch patch;
  patch.size = size;
  patch.detail.assign(static_cast<std::size_t>(size) * static_cast<std::size_t>(size), 0);
  double squares = 0;
  double count = 0;
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) {
      if (inside.at<float>(y, x) == 0) continue;
      const float mean = around.at<float>(y, x) / share.at<float>(y, x);
      // In the dark the detail is noise: the floor keeps it small.
      const float detail = (light.at<float>(y, x) - mean) / (mean + 0.01f);
      const float bounded = std::clamp(detail, -1.0f, 1.0f);
      patch.detail[static_cast<std::size_t>(y * size + x)] =
          static_cast<std::int8_t>(std::lround(bounded * 127));
      squares += static_cast<double>(bounded * bounded);
      ++count;
    }
  }
  patch.sharpness = std::sqrt(squares / std::max(1.0, count));
  return patch;
}

Turning find_turning(std::span<const SurfacePatch> patches, const Mat3& axes) {
  Turning turning;
  turning.axis = axes.transpose() * Vec3::UnitZ();
  const std::vector<cv::Mat> images = moving_detail(patches);
  register_about_middle(images, turning);
  const std::vector<double> confidence = turning.confidence;
  refine_all(images, axes, true, turning);
  turning.confidence = confidence;
  return turning;
}

Turning find_axis(std::span<const SurfacePatch> patches, const Mat3& axes, std::span<const double> angles,
                  bool refine_angles) {
  Turning turning;
  turning.axis = axes.transpose() * Vec3::UnitZ();
  turning.angles.assign(angles.begin(), angles.end());
  turning.confidence.assign(patches.size(), 0);
  refine_all(moving_detail(patches), axes, refine_angles, turning);
  return turning;
}

}  // namespace sateen
