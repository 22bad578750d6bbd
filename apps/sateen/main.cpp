// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cstdio>
#include <new>
#include <numeric>
#include <vector>

#include <fmt/format.h>

#include "command.h"
#include "commands.h"
#include "sateen/core/allocation.h"
#include "sateen/core/error.h"
#include "sateen/io/file.h"
#include "sateen/io/warnings.h"

namespace {

constexpr int kInputIsWrong = 1;
constexpr int kCommandLineIsWrong = 2;

std::size_t edit_distance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
      diagonal = row[j];
      row[j] = std::min({replaced, row[j] + 1, row[j - 1] + 1});
    }
  }
  return row.back();
}

/// The innermost subcommand the user named.
const CLI::App& innermost(const CLI::App& app) {
  const auto chosen = app.get_subcommands();
  return chosen.empty() ? app : innermost(*chosen.front());
}

/// " Did you mean --size?" for an unknown word close to something the command knows; else empty.
std::string suggestion(const CLI::App& app, const std::vector<std::string>& unknown) {
  const CLI::App& command = innermost(app);
  std::vector<std::string> known;
  for (const CLI::App* subcommand : command.get_subcommands([](const CLI::App*) { return true; })) {
    known.push_back(subcommand->get_name());
  }
  for (const CLI::App* level = &command; level != nullptr; level = level->get_parent()) {
    for (const CLI::Option* option : level->get_options()) {
      for (const std::string& name : option->get_lnames()) known.push_back("--" + name);
    }
  }
  for (const std::string& full : unknown) {
    const std::string word = full.substr(0, full.find('='));
    const auto closest = std::ranges::min_element(
        known, {}, [&](const std::string& candidate) { return edit_distance(word, candidate); });
    if (closest != known.end() &&
        edit_distance(word, *closest) <= std::max<std::size_t>(2, word.size() / 4)) {
      return fmt::format(" Did you mean {}?", *closest);
    }
  }
  return "";
}

/// A noun that groups commands: `sateen amc build`.
CLI::App& add_noun(CLI::App& app, const char* name, const char* summary) {
  CLI::App* noun = app.add_subcommand(name, summary);
  noun->require_subcommand(1);
  return *noun;
}

void add_commands(CLI::App& app) {
  using namespace sateen::cli;
  add_render(app);
  add_shade(app);
  CLI::App& capture = add_noun(app, "capture", "From a camera and a turning sphere to an Anisotropic MatCap");
  add_capture_build(capture);
  add_capture_calibrate(capture);
  add_capture_live(capture);
  CLI::App& amc = add_noun(app, "amc", "Anisotropic MatCaps: build from frames, inspect, convert");
  add_amc_build(amc);
  add_amc_symmetry(amc);
  add_amc_info(amc);
  add_amc_pictures(amc);
  add_amc_convert(amc);
  CLI::App& matcap = add_noun(app, "matcap", "MatCap decomposition: turn the light, change the material");
  add_matcap_separate(matcap);
  add_matcap_estimate(matcap);
  add_matcap_decompose(matcap);
  add_matcap_info(matcap);
  add_matcap_bake(matcap);
  CLI::App& brdf = add_noun(app, "brdf", "Reflectance models: evaluate, plot");
  add_brdf_eval(brdf);
  add_brdf_parameters(brdf);
  add_brdf_plot(brdf);
  CLI::App& maps = add_noun(app, "maps", "Texture maps: author, filter, compress");
  CLI::App& aniso = add_noun(maps, "aniso", "Anisotropy maps: author, filter with normals, decode");
  add_maps_aniso_author(aniso);
  add_maps_aniso_decode(aniso);
  add_maps_aniso_filter(aniso);
}

int run(int argc, char** argv) {
  using sateen::cli::say;
  using namespace sateen::cli;
  CLI::App app(
      "Sateen captures how anisotropic materials look, edits that look, and shows it on any 3D model.",
      "sateen");
  app.set_version_flag("--version", SATEEN_VERSION);
  app.require_subcommand(1);
  app.get_formatter()->column_width(34);
  app.option_defaults()->always_capture_default();
  add_commands(app);

  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error);
    // An unknown word explains more than the option that is missing because of it.
    const std::vector<std::string> unknown = app.remaining(true);
    const std::string what =
        unknown.empty() ? error.what() : "unknown here: " + fmt::format("{}", fmt::join(unknown, " "));
    say(fmt::format("{}.{}\nSee --help.", what, suggestion(app, unknown)));
    return kCommandLineIsWrong;
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  using sateen::cli::say;
  sateen::io::remove_temporaries_on_signals();
  sateen::keep_freed_memory();
  sateen::io::set_warning_handler(sateen::cli::warn);
  try {
    return run(argc, argv);
  } catch (const sateen::Error& error) {
    say(error.what());
  } catch (const std::bad_alloc&) {
    say("not enough memory");
  } catch (const std::exception& error) {
    say(std::string("unexpected failure, please report it: ") + error.what());
  }
  return kInputIsWrong;
}
