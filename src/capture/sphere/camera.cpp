// SPDX-License-Identifier: MIT
#include "sateen/capture/sphere/camera.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "sateen/core/error.h"
#include "sateen/io/file.h"
#include "sateen/io/json.h"

namespace sateen::capture {
namespace {

/// Brown-Conrady: where the lens puts the undistorted point (x, y) of the plane at distance 1, y down.
Vec2 distort(const std::array<double, 5>& k, const Vec2& p) {
  const double r2 = p.squaredNorm();
  const double radial = 1 + r2 * (k[0] + r2 * (k[1] + r2 * k[4]));
  return {p.x() * radial + 2 * k[2] * p.x() * p.y() + k[3] * (r2 + 2 * p.x() * p.x()),
          p.y() * radial + k[2] * (r2 + 2 * p.y() * p.y()) + 2 * k[3] * p.x() * p.y()};
}

}  // namespace

Camera Camera::pinhole(int width, int height, double focal_pixels) {
  Camera camera;
  camera.width = width;
  camera.height = height;
  camera.focal = Vec2::Constant(focal_pixels);
  camera.principal = {width / 2.0, height / 2.0};
  return camera;
}

bool Camera::distorted() const {
  return std::ranges::any_of(distortion, [](double k) { return k != 0; });
}

Vec3 Camera::ray(const Vec2& pixel) const {
  const Vec2 seen = (pixel - principal).cwiseQuotient(focal);
  Vec2 p = seen;
  if (distorted()) {
    // Fixed point: a lens bends little, so the error shrinks by its distortion at each round.
    for (int i = 0; i < 30; ++i) {
      const Vec2 error = seen - distort(distortion, p);
      p += error;
      if (error.squaredNorm() < 1e-24) break;
    }
  }
  return Vec3(p.x(), -p.y(), -1).normalized();
}

Vec2 Camera::project(const Vec3& point) const {
  Vec2 p(point.x() / -point.z(), point.y() / point.z());
  if (distorted()) p = distort(distortion, p);
  return principal + p.cwiseProduct(focal);
}

Camera Camera::scaled(double factor) const {
  Camera camera = *this;
  camera.width = static_cast<int>(std::lround(width * factor));
  camera.height = static_cast<int>(std::lround(height * factor));
  camera.focal *= factor;
  camera.principal *= factor;
  return camera;
}

double focal_of_lens(int width, double focal_mm, double sensor_mm) {
  return width * focal_mm / sensor_mm;
}

double focal_of_fov(int width, double fov) {
  return width / 2.0 / std::tan(fov / 2);
}

Camera read_camera(const std::filesystem::path& path) {
  const std::string text = io::read_text(path);
  try {
    const auto json = io::parse_json(text, path.string());
    Camera camera;
    camera.width = json.at("width").get<int>();
    camera.height = json.at("height").get<int>();
    camera.focal = {json.at("focal").at(0).get<double>(), json.at("focal").at(1).get<double>()};
    camera.principal = {json.at("principal").at(0).get<double>(), json.at("principal").at(1).get<double>()};
    camera.distortion = json.at("distortion").get<std::array<double, 5>>();
    if (camera.width < 1 || camera.height < 1 || !(camera.focal.minCoeff() > 0)) {
      throw Error(fmt::format("{}: picture size and focal length must be positive", path.string()));
    }
    return camera;
  } catch (const nlohmann::json::exception&) {
    throw Error(
        fmt::format("{}: is no camera calibration; make one with sateen capture calibrate", path.string()));
  }
}

void write_camera(const std::filesystem::path& path, const Camera& camera, double rms_pixels) {
  const nlohmann::ordered_json json{{"width", camera.width},
                                    {"height", camera.height},
                                    {"focal", {camera.focal.x(), camera.focal.y()}},
                                    {"principal", {camera.principal.x(), camera.principal.y()}},
                                    {"distortion", camera.distortion},
                                    {"rms_pixels", rms_pixels}};
  io::write_text(path, io::json_text(json, 2) + "\n");
}

}  // namespace sateen::capture
