// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "sateen/core/mesh.h"
#include "sateen/core/vector.h"

namespace sateen::scene {

struct Camera {
  enum class Kind {
    perspective,   ///< far enough for the object to fill the picture
    orthographic,  ///< scaled for the object to fill the picture
    view_space,    ///< mesh coordinates are view space; x and y in [-1, 1] fill a square picture,
                   ///< orthographically
  };
  Kind kind = Kind::perspective;
  double field_of_view = radians(35);  ///< vertical, perspective only
  double margin = 0.04;                ///< share of the picture left free around the object
};

/// One pose of the object before the camera.
struct View {
  Mat4 view_from_object = Mat4::Identity();  ///< rotation and translation
  Mat4 clip_from_view = Mat4::Identity();    ///< OpenGL's clip space
  bool perspective = false;                  ///< whether view rays meet in the view space's origin
};

/// One view per rotation of the object, about the middle of its bounding box. The camera is the same for all
/// of them, as near as it can be while it sees the whole object in each, and centred. Light belongs to the
/// camera: it is the object that turns. `aspect` is width / height. Throws Error when the mesh has no
/// vertices or no extent.
std::vector<View> frame_object(const Mesh& mesh, const Camera& camera, std::span<const Mat3> rotations,
                               double aspect);

}  // namespace sateen::scene
