// SPDX-License-Identifier: MIT
// The program libFuzzer drives: the environment variable SATEEN_FUZZ names the reader. See tools/fuzz.
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string_view>

#include "readers.h"
#include "sateen/core/parallel.h"
#include "sateen/io/image.h"
#include "sateen/io/warnings.h"

namespace {

const sateen::test::Reader* chosen = nullptr;

}  // namespace

extern "C" int LLVMFuzzerInitialize(int*, char***) {
  const char* name = std::getenv("SATEEN_FUZZ");
  for (const auto& reader : sateen::test::readers()) {
    if (name != nullptr && reader.name == name) chosen = &reader;
  }
  if (chosen == nullptr) {
    std::fputs("SATEEN_FUZZ must name one of:", stderr);
    for (const auto& reader : sateen::test::readers())
      std::fprintf(stderr, " %.*s", static_cast<int>(reader.name.size()), reader.name.data());
    std::fputs("\n", stderr);
    std::exit(2);
  }
  sateen::limit_threads(1);
  sateen::io::set_max_pixels(1 << 20);
  sateen::io::set_warning_handler([](const std::string&) {});
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  sateen::test::feed(*chosen, std::as_bytes(std::span(data, size)));
  return 0;
}
