// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "sateen/core/progress.h"
#include "sateen/texture/lobe_filter.h"
#include "sateen/texture/mip_rows.h"

namespace sateen::texture {

/// Where the texels of a normal and anisotropy map come from: rows from the top, each once.
class LobeSource {
 public:
  virtual ~LobeSource() = default;
  virtual int width() const = 0;
  virtual int height() const = 0;
  /// The next out.size() / width() rows. Throws Error for a damaged file.
  virtual void read(std::span<LobeTexel> out) = 0;
};

struct LobeRow {
  int y = 0;
  std::vector<LobeTexel> texels;
};

/// Where the mip levels go. Every row of every level comes once. Rows of level 0 come from top to bottom; of
/// the others in any order (with MipWrap::repeat the topmost ones come last).
class LobeSink {
 public:
  virtual ~LobeSink() = default;
  virtual void write(int level, std::span<const LobeRow> rows) = 0;
};

struct ChainOptions {
  FilterOptions filter;
  MipKernel kernel = MipKernel::box;
  MipWrap wrap_u = MipWrap::repeat;
  MipWrap wrap_v = MipWrap::repeat;
  int levels = 0;  ///< 0: the whole chain down to 1 x 1
};

/// Filters normal and anisotropy map together into a mip chain; level 0 is passed on as it came (with
/// `isotropic`, made isotropic). Each level is made from the moments of the level above. Memory is a few
/// dozen rows, whatever the height. The result does not depend on the number of threads.
void filter_lobe_chain(LobeSource& source, LobeSink& sink, const ChainOptions& options,
                       const Progress& progress = {});

}  // namespace sateen::texture
