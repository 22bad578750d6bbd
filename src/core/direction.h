// SPDX-License-Identifier: MIT
#pragma once

#include "sateen/core/vector.h"

namespace sateen {

// View space is right-handed: x right, y up, z towards the viewer. A *disc* point is the (x, y) of a unit
// normal seen by the viewer; picture coordinates run right and down from the top left corner of a square
// picture of the sphere.

/// The unit normal over disc point (x, y); points outside the unit disc give the rim's normal, with z = 0.
Vec3 normal_on_disc(const Vec2& disc);

/// Disc point of the centre of pixel (x, y) of a size x size picture whose row 0 is the top row.
Vec2 disc_of_pixel(int x, int y, int size);

/// Continuous pixel coordinates (centres at +0.5) of a disc point in a size x size picture.
Vec2 pixel_of_disc(const Vec2& disc, int size);

/// The image-plane angle of a direction in turns, k = atan2(t_y, t_x) / 2 pi wrapped into [0, 1) (Magri et
/// al., eq. 3). A direction along the view axis has no angle and gives 0.
double tangent_angle(const Vec3& tangent);

/// x - floor(x / period) * period, kept strictly below period.
double wrap(double x, double period = 1);

/// The smallest rotation that takes `from` to `to`, both unit. Opposite directions turn about any axis
/// across.
Mat3 rotation_between(const Vec3& from, const Vec3& to);

/// Rotation from view space into the *eye frame*, whose z axis points from the shaded point to the eye: the
/// frame in which MatCap-like tables are looked up under perspective. `towards_eye` is unit and in view
/// space.
Mat3 eye_frame(const Vec3& towards_eye);

/// An eye-frame normal as tables of seen normals know it: one that interpolation or a normal map turned away
/// from the eye (z < 0) is taken to the nearest that is seen, on the rim.
Vec3 seen_normal(const Vec3& eye_normal);

/// Equation (4) of Magri et al., kept by name: the x and y of a view-space unit vector corrected for
/// perspective, x and y separately, from the view-space position (eye at the origin, looking down -z). Not a
/// rotation: normals near the picture's corners can land outside the disc. z is left as it is.
Vec3 perspective_equation4(const Vec3& direction, const Vec3& position);

/// Rotation by angles in radians about x, then y, then z.
Mat3 rotation_xyz(const Vec3& angles);

/// An orthonormal pair (tangent, bitangent) completing `normal` to a right-handed frame, continuous away from
/// -z.
void frame_around(const Vec3& normal, Vec3& tangent, Vec3& bitangent);

}  // namespace sateen
