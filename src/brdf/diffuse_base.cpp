// SPDX-License-Identifier: MIT
#include "sateen/brdf/diffuse_base.h"

#include <cmath>

#include "sateen/brdf/bind.h"
#include "sateen/brdf/fibre_diffuse.h"
#include "sateen/brdf/shading_frame.h"

namespace sateen::brdf {
namespace {

using Model = DiffuseBase::Model;

const FibreMoments& moments(Model model) {
  return model == Model::maximum_normal ? kMaximumNormalMoments : kFibreMoments;
}

constexpr std::array kBaseModels{"lambert", "fibre-diffuse", "maximum-normal"};

}  // namespace

std::span<const appearance::ParameterField<DiffuseBase>> diffuse_base_parameters() {
  using appearance::Parameter;
  using appearance::ParameterValue;
  static const std::array<appearance::ParameterField<DiffuseBase>, 3> fields{{
      {{.name = "model",
        .kind = Parameter::Kind::choice,
        .choices = {kBaseModels.begin(), kBaseModels.end()},
        .standard = std::string(kBaseModels[0]),
        .help = "formula of the diffuse base"},
       [](const DiffuseBase& b) { return std::string(kBaseModels[static_cast<std::size_t>(b.model)]); },
       [](DiffuseBase& b, const ParameterValue& v) {
         const auto found = std::ranges::find(kBaseModels, std::get<std::string>(v));
         b.model = static_cast<Model>(found - kBaseModels.begin());
       }},
      {{.name = "color",
        .kind = Parameter::Kind::color,
        .standard = Vec3(0.5, 0.5, 0.5),
        .help = "diffuse albedo, linear"},
       [](const DiffuseBase& b) { return b.color; },
       [](DiffuseBase& b, const ParameterValue& v) { b.color = std::get<Vec3>(v); }},
      {{.name = "azimuth",
        .unit = "degrees",
        .low = -360,
        .high = 360,
        .help = "of the base's fibres, counter-clockwise from the tangent"},
       [](const DiffuseBase& b) { return degrees(b.azimuth); },
       [](DiffuseBase& b, const ParameterValue& v) { b.azimuth = radians(std::get<double>(v)); }},
  }};
  return fields;
}

LightBands bare_bands() {
  return {Vec3::Constant(1), Vec3::Constant(2.0 / 3), Vec3::Constant(0.25)};
}

Vec3 diffuse_lit(const DiffuseBase& base, const Vec3& light) {
  if (light.z() <= 0) return Vec3::Zero();
  if (base.model == Model::lambert) return base.color * (light.z() / kPi);
  const Vec3 local = turned(light, base.azimuth);
  const double value =
      base.model == Model::maximum_normal ? fibre_maximum_normal(local) : fibre_diffuse(local);
  return base.color * (value / moments(base.model).one);
}

Vec3 received(const light::SphericalHarmonics9& light, const Vec3& normal, const LightBands& bands) {
  return light.c[0].cwiseProduct(bands[0]) + light.linear(normal).cwiseProduct(bands[1]) +
         light.quadratic(normal).cwiseProduct(bands[2]);
}

Vec3 diffuse_surroundings(const DiffuseBase& base, const light::SphericalHarmonics9& light, const Mat3& axes,
                          const LightBands& bands) {
  if (base.model == Model::lambert) return base.color.cwiseProduct(received(light, axes.col(2), bands));
  const Vec3 axis(std::cos(base.azimuth), std::sin(base.azimuth), 0);
  const Vec3 fibre = axes * axis;
  const Vec3 across = axes * Vec3(-axis.y(), axis.x(), 0);
  const FibreMoments& m = moments(base.model);
  const Vec3 sum = light.c[0] * m.one + light.linear(axes.col(2)) * m.z + light.quadratic(fibre) * m.xx +
                   light.quadratic(across) * m.yy + light.quadratic(axes.col(2)) * m.zz;
  return base.color.cwiseProduct(sum / m.one).cwiseProduct(bands[0]);
}

void bind_base(const DiffuseBase& base, const LightBands& bands, appearance::ShaderValues& values) {
  set(values, "base_color", narrow(base.color));
  set(values, "base_bands", std::vector<Vec3f>{narrow(bands[0]), narrow(bands[1]), narrow(bands[2])});
  const FibreMoments& m = moments(base.model);
  const bool maximum = base.model == Model::maximum_normal;
  // (|l across the fibre| + x n.l) y, and the moments over the zeroth.
  set(values, "base_lobe", narrow(Vec2(maximum ? 0 : 1, (maximum ? 1 : 1 / kPi) / m.one)));
  set(values, "base_moments", narrow(Vec3(Vec3(m.xx, m.yy, m.zz) / m.one)));
  set(values, "base_moment_z", m.z / m.one);
  set_axis(values, "base_axis", base.azimuth);
}

std::pair<std::string, std::string> define(const DiffuseBase& base) {
  return {"DIFFUSE_FIBRES", base.has_direction() ? "true" : "false"};
}

}  // namespace sateen::brdf
