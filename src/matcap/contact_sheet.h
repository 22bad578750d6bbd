// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <span>

#include "sateen/core/progress.h"
#include "sateen/matcap/batch.h"

namespace sateen::matcap {

/// Writes `folder`/index.html, a page that shows every decomposed MatCap (as it is, low, high, the four
/// sphere maps, three turned lights) with its parameters, and lists what failed; the pictures lie in
/// `folder`/sheet, one strip each, as do the reasons of failures. Strips newer than their MatCap are kept.
/// Processes that work on shards of one batch each write their parts and then the page from what all have
/// done. Throws Error when something cannot be written.
void write_contact_sheet(const std::filesystem::path& folder, std::span<const BatchEntry> entries,
                         const Progress& progress = {});

}  // namespace sateen::matcap
