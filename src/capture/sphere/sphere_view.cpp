// SPDX-License-Identifier: MIT
#include "sateen/capture/sphere/sphere_view.h"

#include <algorithm>
#include <cmath>

#include "sateen/core/direction.h"

namespace sateen::capture {

double SphereView::half_angle() const {
  return std::asin(std::min(1.0, 1 / distance()));
}

double SphereView::radius_pixel(const Camera& camera) const {
  return camera.focal.mean() * std::tan(half_angle());
}

Vec2 SphereView::outline_pixel(const Camera& camera, double azimuth) const {
  const Vec3 towards_eye = -centre.normalized();
  const Mat3 to_view = eye_frame(towards_eye).transpose();
  const double a = half_angle();
  const Vec3 across = to_view * Vec3(std::cos(azimuth), std::sin(azimuth), 0);
  return camera.project(-std::cos(a) * towards_eye + std::sin(a) * across);
}

SphereView sphere_at(const Camera& camera, const Vec2& pixel, double radius) {
  const double half_angle = std::atan(radius / camera.focal.mean());
  return {camera.ray(pixel) / std::sin(half_angle)};
}

bool normal_at_pixel(const Camera& camera, const SphereView& sphere, const Vec2& pixel, Vec3& normal) {
  const Vec3 ray = camera.ray(pixel);
  const double along = ray.dot(sphere.centre);
  const double discriminant = along * along - sphere.centre.squaredNorm() + 1;
  if (discriminant < 0) return false;
  normal = ((along - std::sqrt(discriminant)) * ray - sphere.centre).normalized();
  return true;
}

SeenPoint point_of_disc(const SphereView& sphere, const Vec2& disc, TableFrame frame) {
  SeenPoint point;
  if (frame == TableFrame::view) {
    point.normal = normal_on_disc(disc);
    const Vec3 position = sphere.centre + point.normal;
    point.towards_eye = -position.normalized();
    point.visible = disc.squaredNorm() < 1 && point.normal.dot(point.towards_eye) > 0;
    return point;
  }
  // In the triangle eye, centre, point the law of sines ties the angle at the point, between normal and eye,
  // to the angle at the eye: sin(ray angle) = sin(normal angle) / distance. So the disc is the picture seen
  // in sines.
  const double distance = sphere.distance();
  const double sine = std::min(1.0, disc.norm());
  const double ray_angle = std::asin(sine / distance);
  const double normal_angle = std::asin(sine) - ray_angle;  // at the sphere's centre
  const Vec3 centre_to_eye = -sphere.centre / distance;
  const Mat3 to_view = eye_frame(centre_to_eye).transpose();
  // The eye frames of neighbouring points differ by a parallel transport whose turn about the view ray is the
  // solid angle of the triangle (z, ray, centre ray): second order, so a few corrections are exact.
  const Vec2 wanted = sine > 0 ? Vec2(disc / disc.norm()) : Vec2(1, 0);
  Vec2 azimuth = wanted;
  for (int i = 0; i < 6; ++i) {
    const Vec3 across = to_view * Vec3(azimuth.x(), azimuth.y(), 0);
    point.normal = std::cos(normal_angle) * centre_to_eye + std::sin(normal_angle) * across;
    point.towards_eye = std::cos(ray_angle) * centre_to_eye - std::sin(ray_angle) * across;
    if (sine < 1e-9) break;
    const Vec3 got = eye_frame(point.towards_eye) * point.normal;
    const Vec2 got_azimuth = got.head<2>().normalized();
    const double c = got_azimuth.dot(wanted);
    const double s = got_azimuth.x() * wanted.y() - got_azimuth.y() * wanted.x();
    if (std::abs(s) < 1e-9) break;
    azimuth = Vec2(c * azimuth.x() - s * azimuth.y(), s * azimuth.x() + c * azimuth.y());
  }
  point.visible = disc.squaredNorm() < 1;
  return point;
}

Mat3 table_frame(const SeenPoint& point, TableFrame frame) {
  return frame == TableFrame::eye ? eye_frame(point.towards_eye) : Mat3(Mat3::Identity());
}

}  // namespace sateen::capture
