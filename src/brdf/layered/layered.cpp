// SPDX-License-Identifier: MIT
#include "sateen/brdf/layered/layered.h"

#include <chrono>
#include <cmath>

#include "sateen/brdf/layered/point.h"
#include "sateen/brdf/layered/tables.h"
#include "sateen/core/picture_texture.h"

namespace sateen::brdf {

LayeredAppearance::LayeredAppearance(LayeredMaterial material)
    : wanted_(std::move(material)),
      material_(normalised(wanted_)),
      tables_(std::make_shared<const LayeredTables>(make_tables(material_))) {
  if (material_.fuzz_fibres) {
    fibres_ = std::make_shared<const TextureData>(
        picture_texture(*material_.fuzz_fibres->picture, TextureData::Wrap::repeat, true));
  }
}

LayeredAppearance::~LayeredAppearance() = default;

std::unique_ptr<appearance::Reflectance::Point> LayeredAppearance::at(
    const appearance::Surface& surface) const {
  return std::make_unique<LayeredPoint>(material_, *tables_, surface);
}

appearance::Needs LayeredAppearance::needs() const {
  const bool turning = material_.base.has_direction() ||
                       (material_.specular &&
                        material_.specular->roughness.alpha_t != material_.specular->roughness.alpha_b) ||
                       (material_.fuzz && (material_.fuzz_fibres || std::sin(wanted_.fuzz->tilt) > 1e-9));
  return {.tangents = turning, .uvs = material_.fuzz_fibres.has_value()};
}

std::vector<appearance::Parameter> LayeredAppearance::parameters() const {
  return appearance::descriptions(layered_parameters());
}

appearance::ParameterValue LayeredAppearance::get(const std::string& name) const {
  return appearance::field_named(layered_parameters(), name).get(wanted_);
}

void LayeredAppearance::set(const std::string& name, const appearance::ParameterValue& value) {
  const auto& field = appearance::field_named(layered_parameters(), name);
  appearance::check(field.parameter, value);
  field.set(wanted_, value);
  start();
}

/// Shows what is wanted if its tables are there, and otherwise has them made.
void LayeredAppearance::start() {
  if (making_.valid()) return;  // settle() looks again when these are done
  LayeredMaterial wanted = normalised(wanted_);
  if (fits(*tables_, wanted)) {
    material_ = std::move(wanted);
    tables_ = std::make_shared<const LayeredTables>(make_tables(material_, *tables_));
    changed();
    return;
  }
  making_ = std::async(std::launch::async, [wanted, earlier = tables_] {
    return Made{wanted, std::make_shared<const LayeredTables>(make_tables(wanted, *earlier))};
  });
}

void LayeredAppearance::settle(bool wait) {
  while (making_.valid()) {
    if (!wait && making_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return;
    Made made = making_.get();
    material_ = std::move(made.material);
    tables_ = std::move(made.tables);
    changed();
    start();  // what was set meanwhile
    if (!wait) return;
  }
}

}  // namespace sateen::brdf
