// SPDX-License-Identifier: MIT
#pragma once

#include "sateen/amc/table.h"
#include "sateen/appearance/appearance.h"

namespace sateen::amc {

/// Shows an AMC: one trilinear fetch at the eye-frame normal and the tangent angle, times occlusion (sections
/// 6 and 6.1).
class AmcAppearance final : public appearance::Appearance {
 public:
  explicit AmcAppearance(AmcTable table) : table_(std::move(table)) {}

  Vec3 evaluate(const appearance::Surface& surface) const override;
  appearance::ShaderBinding shader() const override;
  Needs needs() const override { return {.tangents = !table_.isotropic}; }
  int tangent_symmetry() const override { return table_.symmetry; }
  const AmcTable& table() const { return table_; }

 private:
  AmcTable table_;
};

}  // namespace sateen::amc
