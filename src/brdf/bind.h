// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <memory>
#include <utility>

#include "sateen/appearance/shader_module.h"

// Short hands for filling ShaderValues from doubles.

namespace sateen::brdf {

inline Vec2f narrow(const Vec2& v) {
  return v.cast<float>();
}
inline Vec3f narrow(const Vec3& v) {
  return v.cast<float>();
}

inline void set(appearance::ShaderValues& values, const char* name, appearance::UniformValue value) {
  values.uniforms.push_back({name, std::move(value)});
}
inline void set(appearance::ShaderValues& values, const char* name, double value) {
  values.uniforms.push_back({name, static_cast<float>(value)});
}
/// Cosine and sine of an azimuth.
inline void set_axis(appearance::ShaderValues& values, const char* name, double azimuth) {
  set(values, name, narrow(Vec2(std::cos(azimuth), std::sin(azimuth))));
}
inline void set_texture(appearance::ShaderValues& values, const char* name,
                        std::shared_ptr<const TextureData> data) {
  values.textures.push_back({name, std::move(data)});
}

}  // namespace sateen::brdf
