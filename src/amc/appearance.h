// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "sateen/amc/table.h"
#include "sateen/appearance/appearance.h"

namespace sateen::amc {

/// Shows an AMC: one trilinear fetch at the eye-frame normal and the tangent angle, times occlusion (sections
/// 6 and 6.1).
class AmcAppearance final : public appearance::BakedLight {
 public:
  explicit AmcAppearance(AmcTable table);

  Vec3 evaluate(const appearance::Surface& surface) const override;
  appearance::ShaderModule shader() const override;
  appearance::ShaderValues values() const override;
  appearance::Needs needs() const override { return {.tangents = !table_.isotropic}; }
  int tangent_symmetry() const override { return table_.symmetry; }
  const AmcTable& table() const { return table_; }

 private:
  AmcTable table_;
  std::shared_ptr<const TextureData> texture_;
};

}  // namespace sateen::amc
