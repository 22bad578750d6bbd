// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string_view>

namespace sateen::test {

/// Everything that reads files of strangers; one line of a table each. A reader may throw Error and nothing
/// else.
struct Reader {
  std::string_view name;  ///< also of its folder of seeds
  std::string_view file;  ///< what its input is called
  void (*read)(const std::filesystem::path& path);
};

std::span<const Reader> readers();

/// Gives a reader a file of these bytes, in a folder of its own. Lets everything through that is no Error.
void feed(const Reader& reader, std::span<const std::byte> bytes);

}  // namespace sateen::test
