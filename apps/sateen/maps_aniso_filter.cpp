// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "command.h"
#include "commands.h"
#include "json_output.h"
#include "sateen/core/error.h"
#include "sateen/io/file.h"
#include "sateen/texture/lobe_files.h"

namespace sateen::cli {
namespace {

struct MapsAnisoFilterArguments {
  texture::LobeMapFiles files;
  std::filesystem::path output;
  std::vector<double> roughness_values;
  std::string normal_values = "unsigned";
  std::string encoding = "root";
  std::string output_encoding;
  std::string method = "sggx-variance";
  std::string kernel = "box";
  std::string wrap = "repeat";
  std::string wrap_u, wrap_v;
  std::string blocks = "bc";
  std::string effort = "normal";
  bool power_iteration = false;
  bool isotropic = false;
  bool green_down = false;
  int levels = 0;
  int bits = 16;
  int zstd = 9;
  bool json = false;
};

texture::LobeOutput::Kind kind_of(const MapsAnisoFilterArguments& a) {
  const std::string extension = io::extension_of(a.output);
  if (extension == ".png")
    return a.bits == 8 ? texture::LobeOutput::Kind::png8 : texture::LobeOutput::Kind::png;
  if (extension == ".exr") return texture::LobeOutput::Kind::exr;
  if (extension == ".ktx2")
    return a.blocks == "bc" ? texture::LobeOutput::Kind::ktx2_blocks : texture::LobeOutput::Kind::ktx2;
  throw Error(fmt::format("{}: a mip chain is written as .png, .exr or .ktx2", a.output.string()));
}

void run(MapsAnisoFilterArguments a) {
  if (!a.files.anisotropy.empty() && (!a.files.roughness.empty() || !a.roughness_values.empty())) {
    throw CLI::ValidationError("give either --aniso or a roughness, not both");
  }
  if (!a.files.roughness.empty() && !a.roughness_values.empty()) {
    throw CLI::ValidationError("give either --roughness or --constant, not both");
  }
  if (!a.roughness_values.empty()) {
    const double u = a.roughness_values.front();
    const double v = a.roughness_values.back();
    a.files.constant = {u * u, v * v, 0};
  }
  a.files.encoding = texture::anisotropy_encoding_from_name(a.encoding);
  a.files.normal_format = {a.green_down, a.normal_values == "signed"};
  check_outputs({a.output});
  texture::LobeFileSource source(a.files);

  texture::ChainOptions chain;
  chain.filter.method = texture::filter_method_from_name(a.method);
  chain.filter.solver =
      a.power_iteration ? texture::NormalSolver::power_iteration : texture::NormalSolver::eigen;
  chain.filter.encoding = a.files.encoding;
  chain.filter.isotropic = a.isotropic;
  chain.kernel = texture::mip_kernel_from_name(a.kernel);
  chain.wrap_u = texture::mip_wrap_from_name(a.wrap_u.empty() ? a.wrap : a.wrap_u);
  chain.wrap_v = texture::mip_wrap_from_name(a.wrap_v.empty() ? a.wrap : a.wrap_v);
  chain.levels = a.levels;

  texture::LobeOutput output;
  output.kind = kind_of(a);
  output.encoding = a.output_encoding.empty() ? a.files.encoding
                                              : texture::anisotropy_encoding_from_name(a.output_encoding);
  output.green_down = a.green_down;
  output.effort = a.effort == "fast"   ? texture::Bc7Effort::fast
                  : a.effort == "best" ? texture::Bc7Effort::best
                                       : texture::Bc7Effort::normal;
  output.zstd_level = a.zstd;
  const auto written = texture::write_lobe_chain(source, a.output, chain, output, progress_bar("filtering"));

  if (source.repaired() > 0) {
    warn(fmt::format("{}: {} normals had no valid direction; black ones became flat, too long ones were cut",
                     a.files.normals.string(), source.repaired()));
  }
  if (a.json) {
    nlohmann::json report;
    report["width"] = source.width();
    report["height"] = source.height();
    report["repaired_normals"] = source.repaired();
    for (const auto& path : written) report["files"].push_back(path.string());
    print(json_text(report) + "\n");
  }
}

}  // namespace

void add_maps_aniso_filter(CLI::App& parent) {
  auto a = std::make_shared<MapsAnisoFilterArguments>();
  CLI::App* command =
      add_command(parent, "filter", "Make the mip chains of a normal map and an anisotropy map together",
                  "sateen maps aniso filter --normals examples/textures/weave_normal.png --constant 0.5 0.25 "
                  "-o weave.ktx2\n\n"
                  "Writes NAME_normal and NAME_aniso: one .ktx2 each with all levels, or NAME_normal_0.png, "
                  "... a level.");
  command->add_option("--normals", a->files.normals, "Tangent-space normal map; flat when left out");
  command->add_option("--aniso", a->files.anisotropy, "Anisotropy map as `author` makes it");
  command->add_option("--roughness", a->files.roughness,
                      "Instead: an isotropic roughness map (first channel)");
  command->add_option("--constant", a->roughness_values, "Instead: roughness along U and along V [0, 1]")
      ->expected(1, 2)
      ->check(CLI::Range(0.0, 1.0));
  command->add_option("-o,--output", a->output, "NAME.ktx2, NAME.png or NAME.exr")->required();
  command->add_option("--method", a->method, "How lobes are averaged")
      ->check(CLI::IsMember({"sggx-variance", "sggx", "lean", "naive"}));
  command->add_flag("--power-iteration", a->power_iteration,
                    "sggx methods: the slides' solver for the normal");
  command->add_flag("--isotropic", a->isotropic, "Make every lobe isotropic, for engines without anisotropy");
  command->add_option("--kernel", a->kernel, "Filter kernel")->check(CLI::IsMember({"box", "kaiser"}));
  const auto wraps = CLI::IsMember({"repeat", "clamp", "mirror"});
  command->add_option("--wrap", a->wrap, "What lies beyond the border (matters to kaiser)")->check(wraps);
  command->add_option("--wrap-u", a->wrap_u, "The same along U only")->check(wraps);
  command->add_option("--wrap-v", a->wrap_v, "The same along V only")->check(wraps);
  command->add_option("--levels", a->levels, "Mip levels; 0: down to 1 x 1")->check(CLI::Range(0, 32));
  command->add_flag("--green-down", a->green_down,
                    "The normal map is Direct3D style, here and in the output");
  command->add_option("--normal-values", a->normal_values, "unsigned: n/2 + 1/2 is stored; signed: n (EXR)")
      ->check(CLI::IsMember({"unsigned", "signed"}));
  command->add_option("--encoding", a->encoding, "Encoding of the anisotropy map")
      ->check(CLI::IsMember({"root", "correlation"}));
  command->add_option("--output-encoding", a->output_encoding, "Encoding to write; left out: the same")
      ->check(CLI::IsMember({"root", "correlation"}));
  command->add_option("--compress", a->blocks, ".ktx2: bc (BC5 and BC7 blocks) or none")
      ->check(CLI::IsMember({"bc", "none"}));
  command->add_option("--effort", a->effort, "BC7: quality against time")
      ->check(CLI::IsMember({"fast", "normal", "best"}));
  command->add_option("--zstd", a->zstd, ".ktx2: Zstandard level, 0 for none")->check(CLI::Range(0, 22));
  command->add_option("--bits", a->bits, "Of PNGs")->check(CLI::IsMember({8, 16}));
  command->add_flag("--json", a->json, "Print the files written as JSON");
  command->callback([a] { run(*a); });
}

}  // namespace sateen::cli
