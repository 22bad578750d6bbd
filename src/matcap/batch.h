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
  bool elsewhere = false;  ///< another shard's: nothing was done about it
  bool reused = false;     ///< an earlier run had made the output, of this input with these options
  std::string failure;     ///< empty: it worked
};

/// Which of a batch's inputs one process takes: `number` of `count`, from 1.
struct Shard {
  int number = 1;
  int count = 1;
};

/// Decomposes `inputs` into `folder` as NAME.ktx2, in parallel; of them every count-th is this shard's.
/// Outputs that are already there, whole, made of the same bytes with these options, stay as they are unless
/// `anew`: an interrupted run goes on where it stopped. An input that fails, for whatever reason, stops no
/// other and leaves an older output as it was. Throws Error when two inputs have the same name or the folder
/// cannot be made.
std::vector<BatchEntry> decompose_files(std::span<const std::filesystem::path> inputs,
                                        const std::filesystem::path& folder,
                                        const DecomposeFileOptions& options, bool anew,
                                        const Progress& progress = {}, Shard shard = {});

}  // namespace sateen::matcap
