// SPDX-License-Identifier: MIT
// The program sateen-read-picture FILE KIND: writes a picture of a kind OpenImageIO reads to standard output,
// see picture_process.h.
#include <array>
#include <cstdio>
#include <exception>

#include <sys/resource.h>
#include <unistd.h>

#include "oiio_source.h"
#include "sateen/io/picture_process.h"

namespace sateen::io {
namespace {

void put(const void* bytes, std::size_t count) {
  if (count > 0 && std::fwrite(bytes, 1, count, stdout) != count) _exit(1);  // nobody listens any more
}

void send(const std::string& path, const std::string& kind) {
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
#ifndef SATEEN_SANITIZED  // sanitizers take addresses by the terabyte and write files of their own
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
    if (count != 3) return 2;
    sateen::io::bound();
    sateen::io::send(arguments[1], arguments[2]);
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
