// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "sateen/core/progress.h"
#include "sateen/matcap/decomposition.h"

namespace sateen::matcap {

/// How files of MatCaps are decomposed.
struct DecomposeFileOptions {
  DecomposeOptions decompose;
  std::optional<Disc> disc;  ///< where the spheres are; otherwise they are found
  std::string program;       ///< put into the files' provenance
};

/// Reads, decomposes and writes one MatCap.
MatcapDecomposition decompose_file(const std::filesystem::path& input, const std::filesystem::path& output,
                                   const DecomposeFileOptions& options);

/// What became of one input.
struct BatchEntry {
  std::filesystem::path input;
  std::filesystem::path output;
  bool reused = false;  ///< an earlier run had made the output, of this input with these options
  std::string failure;  ///< empty: it worked
};

/// Decomposes `inputs` into `folder` as NAME.ktx2, in parallel. Outputs that are already there for the same
/// input (name, size) and options stay as they are unless `anew`: an interrupted run goes on where it
/// stopped. An input that fails does not stop the others. Throws Error when two inputs have the same name or
/// the folder cannot be made.
std::vector<BatchEntry> decompose_files(std::span<const std::filesystem::path> inputs,
                                        const std::filesystem::path& folder,
                                        const DecomposeFileOptions& options, bool anew,
                                        const Progress& progress = {});

}  // namespace sateen::matcap
