// SPDX-License-Identifier: MIT
#pragma once

#include "sateen/core/texture_data.h"
#include "sateen/gpu/handle.h"

namespace sateen::gpu {

/// A texture with everything sampling needs: linear filtering, between mip levels too when there are several.
class Texture {
 public:
  /// Uploads `data`. Throws Error when it is larger than the driver takes or its levels' sizes do not fit.
  explicit Texture(const TextureData& data);

  void bind(int unit) const;

 private:
  unsigned target_ = 0;
  Handle handle_;
};

}  // namespace sateen::gpu
