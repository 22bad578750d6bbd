// SPDX-License-Identifier: MIT
// The switches of the surface pipeline and their default values; the renderer defines others in front of this text.

#define TANGENT_ANGLE_VERTEX 0    // k from the vertices with the two-k trick of section 6.2
#define TANGENT_ANGLE_NAIVE 1     // k from the vertices as it is: the artefact of Figure 9
#define TANGENT_ANGLE_FRAGMENT 2  // tangent from the vertices, its angle taken in the fragment

#define PERSPECTIVE_ROTATION 0   // the full rotation that takes the view ray to z
#define PERSPECTIVE_EQUATION4 1  // the paper's equation (4)
#define PERSPECTIVE_NONE 2       // view space as it is

#ifndef TANGENT_ANGLE
#define TANGENT_ANGLE TANGENT_ANGLE_VERTEX
#endif
#ifndef TANGENT_SYMMETRY
#define TANGENT_SYMMETRY 1.0  // R
#endif
#ifndef PERSPECTIVE
#define PERSPECTIVE PERSPECTIVE_ROTATION
#endif
#ifndef RENORMALISE
#define RENORMALISE true
#endif
#ifndef OCCLUSION
#define OCCLUSION true
#endif
#ifndef NORMAL_MAP
#define NORMAL_MAP false
#endif
#ifndef DIRECTION_MAP
#define DIRECTION_MAP false
#endif
#ifndef OCCLUSION_MAP
#define OCCLUSION_MAP false
#endif
#ifndef WRITE_SURFACE
#define WRITE_SURFACE 0  // 1: four targets of the packed surface in place of the colour
#endif
#ifndef CURVATURE
#define CURVATURE 0  // 1: the directional curvature is there
#endif
#ifndef APPEARANCE
#define APPEARANCE constant_appearance
#endif
