// SPDX-License-Identifier: MIT
#include "readers.h"

#include <algorithm>
#include <fstream>
#include <vector>

#include "sateen/amc/amc_file.h"
#include "sateen/brdf/evaluation.h"
#include "sateen/capture/photographs/lens_notes.h"
#include "sateen/capture/rig/live.h"
#include "sateen/capture/sphere/camera.h"
#include "sateen/core/error.h"
#include "sateen/io/exif.h"
#include "sateen/io/file.h"
#include "sateen/io/image.h"
#include "sateen/io/image_memory.h"
#include "sateen/io/image_rows.h"
#include "sateen/io/ktx2.h"
#include "sateen/io/mesh.h"
#include "sateen/io/picture8.h"
#include "sateen/io/video_reader.h"
#include "sateen/matcap/decomposition_file.h"
#include "sateen/matcap/edits.h"
#include "sateen/scene/registry.h"
#include "sateen/texture/lobe_mips.h"
#include "support/files.h"

namespace sateen::test {
namespace {

namespace fs = std::filesystem;

/// Calls each; one that refuses the file keeps none of the others from it.
template <class... Calls>
void each(Calls... calls) {
  const auto one = [](const auto& call) {
    try {
      call();
    } catch (const Error&) {
    }
  };
  (one(calls), ...);
}

void read_picture(const fs::path& path) {
  each([&] { io::read_image_info(path); }, [&] { io::read_image(path); },
       [&] { io::read_image(path, {.allow_non_finite = true, .most_across = 7}); },
       [&] {
         io::read_image(path, {.region = PixelRect{1, 1, 3, 2}});
       },
       [&] { io::read_picture8(path); }, [&] { io::read_exif_of_file(path); },
       [&] {
         io::ImageRowReader rows(path);
         std::vector<float> row(static_cast<std::size_t>(rows.width()) *
                                static_cast<std::size_t>(rows.channels()));
         for (int y = 0; y < std::min(rows.height(), 500); ++y) rows.read(row);
       });
}

void read_picture_and_memory(const fs::path& path) {
  read_picture(path);
  each([&] { io::read_data_from_memory(io::read_bytes(path), "the picture"); });
}

void read_mesh(const fs::path& path) {
  io::read_model(path);
}

void read_film(const fs::path& path) {
  io::VideoReader film(path);
  io::Picture8 frame;
  for (int i = 0; i < 40 && (i % 3 == 0 ? film.skip() : film.next(frame)); ++i) {
  }
}

constexpr Reader kReaders[] = {
    {"ktx2", "a.ktx2",
     [](const fs::path& path) { each([&] { io::read_ktx2_info(path); }, [&] { io::read_ktx2(path); }); }},
    {"amc", "a.ktx2", [](const fs::path& path) { amc::read_amc(path); }},
    {"matcap", "a.ktx2", [](const fs::path& path) { matcap::read_matcap(path); }},
    {"maps", "a.ktx2", [](const fs::path& path) { texture::read_lobe_mips(path, path); }},
    {"png", "a.png", read_picture_and_memory},
    {"jpeg", "a.jpg", read_picture_and_memory},
    {"webp", "a.webp", read_picture_and_memory},
    {"exr", "a.exr", read_picture},
    {"hdr", "a.hdr", read_picture},
    {"tiff", "a.tif", read_picture},
    {"ply", "a.ply", read_mesh},
    {"obj", "a.obj", read_mesh},
    {"gltf", "a.gltf", read_mesh},
    {"glb", "a.glb", read_mesh},
    {"film", "a.mp4", read_film},
    {"material", "a.json", [](const fs::path& path) { scene::load_material(path); }},
    {"edits", "a.json", [](const fs::path& path) { matcap::read_edits(path); }},
    {"camera", "a.json", [](const fs::path& path) { capture::read_camera(path); }},
    {"directions", "a.json", [](const fs::path& path) { brdf::read_direction_pairs(path); }},
    {"brdf", "a.json",
     [](const fs::path& path) {
       for (const std::string& model : brdf::brdf_models()) each([&] { brdf::read_brdf(model, path); });
     }},
    {"plan", "capture.json", [](const fs::path& path) { capture::stage_angles(path.parent_path()); }},
    {"amc_folder", "amc.json", [](const fs::path& path) { amc::read_amc(path.parent_path()); }},
};

}  // namespace

std::span<const Reader> readers() {
  return kReaders;
}

void feed(const Reader& reader, std::span<const std::byte> bytes) {
  static const TemporaryFolder folder;
  const fs::path path = folder / std::string(reader.file);
  std::ofstream(path, std::ios::binary)
      .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  each([&] { reader.read(path); });
}

}  // namespace sateen::test
