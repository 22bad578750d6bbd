// SPDX-License-Identifier: MIT
// Materials and light for the tests of layered materials.
#pragma once

#include <cmath>
#include <memory>
#include <random>

#include "sateen/brdf/research/slides.h"
#include "support/sky.h"

namespace sateen::test {

inline const light::Lighting& everything() {
  static const light::Lighting shared = [] {
    light::Lighting lighting;
    light::PunctualLight key;
    key.direction = Vec3(-0.4, 0.6, 0.7).normalized();
    light::PunctualLight point;
    point.kind = light::PunctualLight::Kind::point;
    point.position = {2, 0, -3};
    point.colour = {2, 3, 4};
    light::PunctualLight spot = point;
    spot.kind = light::PunctualLight::Kind::spot;
    spot.position = {-1, 2, -2};
    spot.direction = Vec3(0.2, -0.4, -0.5).normalized();
    spot.inner_cone = 0.2;
    spot.outer_cone = 0.7;
    lighting.lamps = {key, point, spot};
    lighting.surroundings = light::make_surroundings(sky());
    return lighting;
  }();
  return shared;
}

inline light::Lighting uniform_light() {
  light::Lighting lighting;
  lighting.surroundings = light::make_surroundings(Image(64, 32, 3, 1));
  return lighting;
}

inline brdf::LayeredMaterial fuzzy(brdf::FuzzPhase phase = brdf::FuzzPhase::sggx) {
  brdf::LayeredMaterial material;
  material.base.color = {0.3, 0.1, 0.1};
  material.fuzz = brdf::FuzzParameters{};
  material.fuzz->phase = phase;
  material.fuzz->alpha = 0.35;
  material.fuzz->k = 0.6;
  material.fuzz->tilt = radians(50);
  material.fuzz->azimuth = radians(30);
  material.fuzz->colour = {1, 0.6, 0.4};
  return material;
}

inline brdf::LayeredMaterial glossy() {
  brdf::LayeredMaterial material;
  material.specular = brdf::GgxParameters{{0.2, 0.6, radians(25)}, {0.9, 0.6, 0.3}, true};
  return material;
}

/// A material under light.
struct Lit {
  std::shared_ptr<appearance::Appearance> appearance;
  light::Lighting lighting;
  Lit(brdf::LayeredMaterial material, light::Lighting light)
      : appearance(std::make_shared<brdf::LayeredAppearance>(std::move(material))),
        lighting(std::move(light)) {}
  Lit(brdf::SlidesMaterial material, light::Lighting light)
      : appearance(std::make_shared<brdf::SlidesAppearance>(std::move(material))),
        lighting(std::move(light)) {}
  Vec3 evaluate(const appearance::Surface& surface) const { return appearance->radiance(surface, lighting); }
};

/// A surface point facing the viewer's z axis, seen from `view`.
inline appearance::Surface flat(const Vec3& view) {
  appearance::Surface surface;
  surface.view = view;
  return surface;
}

/// Brushed pile: tilts from nearly upright to lying, all azimuths, changing from texel to texel.
inline brdf::FibreMap brushed() {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> value(0, 1);
  auto picture = std::make_shared<Image>(5, 4, 3);
  for (int y = 0; y < 4; ++y) {
    for (int x = 0; x < 5; ++x) {
      const double sine = std::sin(value(random) * kPi / 2);
      const double azimuth = 2 * kPi * value(random);
      picture->set_rgb(x, y,
                       Vec3f(static_cast<float>(0.5 + 0.5 * sine * std::cos(azimuth)),
                             static_cast<float>(0.5 + 0.5 * sine * std::sin(azimuth)), 0));
    }
  }
  return {picture, {1, 1}};
}

}  // namespace sateen::test
