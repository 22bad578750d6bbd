// SPDX-License-Identifier: MIT
// The program sateen-read-picture FILE: writes a picture of a kind OpenImageIO reads to standard output, see
// picture_process.h.
#include <array>
#include <cctype>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <string_view>

#include <sys/resource.h>
#include <unistd.h>

#include "oiio_source.h"
#include "sateen/io/picture_process.h"

namespace sateen::io {
namespace {

/// OpenImageIO's name of a kind, and how its files begin.
struct Kind {
  std::string_view name;
  std::string_view start;
  std::size_t at = 0;
};

using namespace std::string_view_literals;
constexpr Kind kKinds[] = {
    {"gif", "GIF87a"},
    {"gif", "GIF89a"},
    {"bmp", "BM"},
    {"psd", "8BPS"},
    {"dpx", "SDPX"},
    {"dpx", "XPDS"},
    {"cineon", "\x80\x2a\x5f\xd7"},
    {"cineon", "\xd7\x5f\x2a\x80"},
    {"sgi", "\x01\xda"},
    {"dds", "DDS "},
    {"jpeg2000", "\0\0\0\x0cjP"sv},
    {"jpeg2000", "\xff\x4f\xff\x51"},
    {"ico", "\0\0\1\0"sv},
    {"fits", "SIMPLE"},
    {"heif", "ftyphei", 4},
    {"heif", "ftypmif1", 4},
    {"heif", "ftypmsf1", 4},
    {"heif", "ftypavif", 4},
    {"iff", "FOR4"},
    {"softimage", "\x53\x80\xf6\x34"},
    {"pnm", "P1"},
    {"pnm", "P2"},
    {"pnm", "P3"},
    {"pnm", "P4"},
    {"pnm", "P5"},
    {"pnm", "P6"},
    {"pnm", "Pf"},
    {"pnm", "PF"},
    // Those of the library's own kinds that it leaves to OpenImageIO.
    {"tiff", "II*\0"sv},
    {"tiff", "MM\0*"sv},
    {"tiff", "II+\0"sv},
    {"tiff", "MM\0+"sv},
    {"webp", "WEBP", 8},
    {"jpeg", "\xff\xd8\xff"},
    {"png", "\x89PNG"},
    {"openexr", "\x76\x2f\x31\x01"},
};

/// Kinds that only their extension tells.
struct Ending {
  std::string_view name;
  std::string_view extension;
};
constexpr Ending kEndings[] = {
    {"targa", ".tga"}, {"targa", ".tpic"}, {"rla", ".rla"}, {"zfile", ".zfile"}, {"raw", ".cr2"},
    {"raw", ".cr3"},   {"raw", ".nef"},    {"raw", ".arw"}, {"raw", ".dng"},     {"raw", ".orf"},
    {"raw", ".rw2"},   {"raw", ".raf"},    {"raw", ".pef"}, {"raw", ".srw"},     {"raw", ".crw"},
    {"raw", ".nrw"},   {"raw", ".sr2"},    {"raw", ".3fr"}, {"raw", ".erf"},     {"raw", ".iiq"},
    {"raw", ".mrw"},   {"raw", ".x3f"},    {"raw", ".kdc"}, {"raw", ".mef"},
};

/// The one decoder to ask; none of the others gets to see the file.
std::string kind_of(const std::string& path) {
  std::string first(16, '\0');
  std::ifstream file(path, std::ios::binary);
  file.read(first.data(), static_cast<std::streamsize>(first.size()));
  first.resize(static_cast<std::size_t>(file.gcount()));
  std::string extension = std::filesystem::path(path).extension().string();
  std::ranges::transform(extension, extension.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  for (const Ending& ending : kEndings) {
    if (ending.extension == extension) return std::string(ending.name);
  }
  for (const Kind& kind : kKinds) {
    if (std::string_view(first).substr(std::min(kind.at, first.size())).starts_with(kind.start))
      return std::string(kind.name);
  }
  fail(path, "cannot be read as a picture: its first bytes are those of no known kind");
}

void put(const void* bytes, std::size_t count) {
  if (count > 0 && std::fwrite(bytes, 1, count, stdout) != count) _exit(1);  // nobody listens any more
}

void send(const std::string& path) {
  const std::string kind = kind_of(path);
  OIIO::ImageSpec wishes;
  wishes["oiio:UnassociatedAlpha"] = 1;
  auto input = OIIO::ImageInput::create(kind);
  OIIO::ImageSpec found;
  if (!input || !input->open(path, found, wishes)) {
    fail(path, "cannot be read as a picture: " + image_reason(input ? input->geterror() : OIIO::geterror()));
  }
  OiioSource source(path, std::move(input));
  const PictureHeader& header = source.header();
  PictureStart start;
  start.width = header.width;
  start.height = header.height;
  start.channels = header.channels;
  start.samples = static_cast<std::int32_t>(header.samples);
  start.bits = header.bits;
  start.floating = header.floating ? 1 : 0;
  start.alpha = header.alpha;
  start.associated = header.associated ? 1 : 0;
  start.orientation = header.orientation;
  const PixelRect& window = header.window;
  std::ranges::copy(std::array{window.x, window.y, window.width, window.height}, start.window);
  start.icc_bytes = static_cast<std::uint32_t>(header.colour.icc.size());
  put(&start, sizeof start);
  put(header.colour.icc.data(), header.colour.icc.size());
  std::fflush(stdout);
  std::vector<std::byte> row(header.row_bytes());
  for (int y = 0; y < header.height; ++y) {
    source.read(1, row.data());
    put(row.data(), row.size());
  }
  if (std::fflush(stdout) != 0) _exit(1);
}

void bound() {
  const auto limit = [](auto resource, rlim_t most) {
    const rlimit value{most, most};
    setrlimit(resource, &value);
  };
#if !defined(__SANITIZE_ADDRESS__)  // which takes addresses by the terabyte and writes files of its own
  limit(RLIMIT_AS, kMostAddresses);
  limit(RLIMIT_FSIZE, 0);
#endif
  limit(RLIMIT_CPU, kMostSeconds);
  limit(RLIMIT_CORE, 0);
}

}  // namespace
}  // namespace sateen::io

int main(int count, char** arguments) {
  std::string message = "cannot be read";
  try {
    if (count != 2) return 2;
    sateen::io::bound();
    sateen::io::send(arguments[1]);
    return 0;
  } catch (const sateen::Error& error) {
    // Ours names the file; whoever started this does that too.
    message = error.what();
    const std::string named = std::string(arguments[1]) + ": ";
    if (message.starts_with(named)) message = message.substr(named.size());
  } catch (const std::bad_alloc&) {
    message = "cannot be read as a picture: its decoder asks for more memory than it may take";
  } catch (const std::exception& error) {
    message = std::string("cannot be read as a picture: ") + error.what();
  }
  const ssize_t told = write(sateen::io::kMessageFile, message.data(), message.size());
  return told < 0 ? 2 : 1;
}
