// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <filesystem>
#include <string>

#include "sateen/capture/capture.h"

namespace sateen::capture {

/// The report as JSON text: `frames` (file, angle_degrees, turned_degrees, center, radius, exposure,
/// white_balance, sharpness, used, dropped), `sphere`, `camera`, `axis`, `turn`, `photometry`, `symmetry`,
/// `mask`, `warnings`. Its keys are described in docs/capture.md.
std::string report_json(const CaptureResult& result);

/// The names of what write_report writes.
inline constexpr std::array<const char*, 2> kReportFiles{"report.json", "report.html"};

/// DIR/report.json and DIR/report.html, one page that needs no other file: the outline and axis on a frame,
/// curves of angle and exposure, the mask, slices, symmetry, and warnings with what to do. Makes the folder.
/// Throws Error when it cannot be written.
void write_report(const std::filesystem::path& folder, const CaptureResult& result);

}  // namespace sateen::capture
