// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <span>

#include "sateen/texture/bc7.h"
#include "sateen/texture/lobe_chain.h"

namespace sateen::texture {

/// "sateen.kind" and "sateen.version" of the .ktx2 files of a chain.
inline constexpr const char* kNormalMapKind = "normal-map";
inline constexpr const char* kAnisotropyMapKind = "anisotropy-map";
inline constexpr int kLobeFileVersion = 1;

/// How a normal map stores its vectors.
struct NormalMapFormat {
  bool green_down = false;  ///< Direct3D style; otherwise green up (OpenGL, glTF)
  bool is_signed =
      false;  ///< samples are the components in [-1, 1] (EXR); otherwise [0, 1] holds n / 2 + 1/2
};

/// The unit normal of a pixel with 2 or more channels. z is rebuilt from x and y where the map has no blue
/// channel or blue is 0. A black pixel (unsigned) or zero vector (signed) has no direction: +z, and
/// `repaired` becomes true; it does as well where x and y alone are longer than 1.
Vec3 decode_normal(std::span<const float> pixel, const NormalMapFormat& format, bool& repaired);

/// The maps of a material. Those with an empty path are constant: flat normals; the lobe `constant`.
struct LobeMapFiles {
  std::filesystem::path normals;
  NormalMapFormat normal_format;
  std::filesystem::path anisotropy;  ///< three channels as `encoding` says
  AnisotropyEncoding encoding = AnisotropyEncoding::root;
  std::filesystem::path
      roughness;  ///< instead of `anisotropy`: isotropic, first channel, alpha = roughness^2
  brdf::AnisotropicRoughness constant;  ///< when neither map is given
};

/// Reads the maps row by row.
class LobeFileSource : public LobeSource {
 public:
  /// Throws Error when neither normals nor anisotropy nor roughness is given, when a file is no picture, when
  /// their sizes differ or channels are missing.
  explicit LobeFileSource(const LobeMapFiles& files);
  ~LobeFileSource() override;

  int width() const override;
  int height() const override;
  void read(std::span<LobeTexel> out) override;

  /// Normals without direction met so far (decode_normal).
  std::size_t repaired() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// What the mip chain is written as.
struct LobeOutput {
  enum class Kind {
    png,          ///< one 16-bit file a level and map
    png8,         ///< the same with 8 bits
    exr,          ///< the same, half float; normals signed
    ktx2,         ///< one file a map with all levels: 8-bit RG and RGBA
    ktx2_blocks,  ///< the same as BC5 (normal x and y) and BC7
  };
  Kind kind = Kind::png;
  AnisotropyEncoding encoding = AnisotropyEncoding::root;
  bool green_down = false;
  Bc7Effort effort = Bc7Effort::normal;
  int zstd_level = 9;
};

/// Filters the maps of `source` and writes the levels beside `base`: BASE_normal_0.png, BASE_aniso_0.png, ...
/// or BASE_normal.ktx2 and BASE_aniso.ktx2 (`base` without its extension). Returns the files in the order of
/// levels. A few dozen rows are held in memory; of KTX2 all levels, as they will be stored, and of pictures
/// with MipKernel::kaiser and MipWrap::repeat those below the first. Throws Error when a file cannot be read
/// or written; files of a failed run are removed.
std::vector<std::filesystem::path> write_lobe_chain(LobeSource& source, const std::filesystem::path& base,
                                                    const ChainOptions& chain, const LobeOutput& output,
                                                    const Progress& progress = {});

}  // namespace sateen::texture
