// SPDX-License-Identifier: MIT
#pragma once

#include "sateen/capture/sphere/camera.h"
#include "sateen/core/vector.h"

namespace sateen::capture {

/// In which frame a table's normals are expressed when the camera sees the sphere in perspective.
enum class TableFrame {
  eye,  ///< z points at the eye from each surface point: what the lookups of this library use; the whole disc
        ///< is seen
  view,  ///< z is the camera's optical axis everywhere; normals near the rim are hidden from a near camera
};

/// A sphere of radius 1 (lengths in a picture have no scale) as one camera sees it. View space, eye at the
/// origin.
struct SphereView {
  Vec3 centre{0, 0, -10};

  double distance() const { return centre.norm(); }
  /// Half the opening angle of the cone that touches the sphere.
  double half_angle() const;
  /// Where the camera puts the sphere's centre. The outline is an ellipse whose own centre lies a little
  /// further out.
  Vec2 centre_pixel(const Camera& camera) const { return camera.project(centre); }
  /// Radius of the outline in pixels, were the sphere in the middle of the picture: f tan(half_angle).
  double radius_pixel(const Camera& camera) const;
  /// The outline's pixel at `azimuth` radians, counter-clockwise about the ray to the centre.
  Vec2 outline_pixel(const Camera& camera, double azimuth) const;
};

/// The sphere whose centre is seen at `pixel` and whose radius_pixel is `radius`.
SphereView sphere_at(const Camera& camera, const Vec2& pixel, double radius);

/// Where the ray through a pixel meets the sphere first: its outward unit normal. False if it misses.
bool normal_at_pixel(const Camera& camera, const SphereView& sphere, const Vec2& pixel, Vec3& normal);

/// A surface point for a disc point of a table. The point is `sphere.centre + normal`.
struct SeenPoint {
  Vec3 normal;       ///< view space
  Vec3 towards_eye;  ///< view space, unit
  bool visible = false;
};
SeenPoint point_of_disc(const SphereView& sphere, const Vec2& disc, TableFrame frame);

/// Rotation from view space to the table's frame at that point: identity for TableFrame::view.
Mat3 table_frame(const SeenPoint& point, TableFrame frame);

}  // namespace sateen::capture
