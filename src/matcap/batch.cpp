// SPDX-License-Identifier: MIT
#include "sateen/matcap/batch.h"

#include <atomic>
#include <set>

#include <fmt/format.h>

#include "sateen/core/error.h"
#include "sateen/core/parallel.h"
#include "sateen/io/checksum.h"
#include "sateen/io/file.h"
#include "sateen/io/ktx2.h"
#include "sateen/matcap/decomposition_file.h"
#include "sateen/matcap/matcap_picture.h"

namespace sateen::matcap {
namespace {

namespace fs = std::filesystem;

/// What an output depends on besides the input, as text to compare.
std::string signature_of(const DecomposeFileOptions& options) {
  std::string text = fmt::format("space={} outliers={} map={}", static_cast<int>(options.decompose.space),
                                 static_cast<int>(options.decompose.outliers), options.decompose.map_size);
  for (const Part part : kParts) {
    for (const Region& r : options.decompose.regions[static_cast<std::size_t>(part)]) {
      text += fmt::format(" {}={},{},{},{}", name_of(part), r.x, r.y, r.width, r.height);
    }
  }
  if (options.disc)
    text += fmt::format(" disc={},{},{}", options.disc->x, options.disc->y, options.disc->radius);
  return text;
}

std::map<std::string, std::string> provenance_of(const fs::path& input, const DecomposeFileOptions& options) {
  return {{"source", input.filename().string()},
          {"source_checksum", io::checksum(io::read_bytes(input))},
          {"options", signature_of(options)},
          {"program", options.program}};
}

bool is_there(const fs::path& input, const fs::path& output, const DecomposeFileOptions& options) {
  std::error_code code;
  if (!fs::exists(output, code)) return false;
  try {
    return read_matcap_parameters(output).provenance == provenance_of(input, options) &&
           io::ktx2_is_whole(output);
  } catch (const Error&) {
    return false;  // of another kind or damaged: made anew
  }
}

}  // namespace

MatcapDecomposition decompose_file(const fs::path& input, const fs::path& output,
                                   const DecomposeFileOptions& options) {
  const MatcapPicture picture = read_matcap_picture(input, options.disc);
  MatcapDecomposition matcap = decompose(picture.image, picture.disc, options.decompose, input.string());
  matcap.provenance = provenance_of(input, options);
  write_matcap(output, matcap);
  return matcap;
}

std::vector<BatchEntry> decompose_files(std::span<const fs::path> inputs, const fs::path& folder,
                                        const DecomposeFileOptions& options, bool anew,
                                        const Progress& progress, Shard shard) {
  std::vector<BatchEntry> entries;
  std::set<fs::path> names;
  for (const fs::path& input : inputs) {
    const fs::path output = folder / (input.stem().string() + ".ktx2");
    if (!names.insert(output).second) {
      throw Error(fmt::format("{}: another input would also become {}; give them different names or folders",
                              input.string(), output.string()));
    }
    const bool elsewhere = static_cast<int>(entries.size()) % shard.count != shard.number - 1;
    entries.push_back({input, output, elsewhere, false, {}});
  }
  io::make_folder(folder);
  std::atomic<int> done = 0;
  const int count = static_cast<int>(entries.size());
  parallel_for(count, [&](int i) {
    BatchEntry& entry = entries[static_cast<std::size_t>(i)];
    if (!entry.elsewhere) {
      entry.failure = failure_of(entry.input.string(), [&] {
        entry.reused = !anew && is_there(entry.input, entry.output, options);
        if (!entry.reused) decompose_file(entry.input, entry.output, options);
      });
    }
    report(progress, static_cast<double>(++done) / count);
  });
  return entries;
}

}  // namespace sateen::matcap
