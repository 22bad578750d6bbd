// SPDX-License-Identifier: MIT
#pragma once

#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <string>
#include <system_error>
#include <thread>

#include <OpenEXR/Iex.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfThreading.h>

namespace sateen::io {

/// OpenEXR's reading from a C stream.
class ExrInput final : public Imf::IStream {
 public:
  ExrInput(const std::string& name, std::FILE* stream) : IStream(name.c_str()), stream_(stream) {}
  bool read(char to[], int count) override {
    if (std::fread(to, 1, static_cast<std::size_t>(count), stream_) != static_cast<std::size_t>(count))
      throw Iex::InputExc("unexpected end of file");
    return true;
  }
  std::uint64_t tellg() override { return static_cast<std::uint64_t>(std::ftell(stream_)); }
  void seekg(std::uint64_t position) override { std::fseek(stream_, static_cast<long>(position), SEEK_SET); }
  void clear() override { std::clearerr(stream_); }

 private:
  std::FILE* stream_;
};

/// OpenEXR's writing to a C stream.
class ExrOutput final : public Imf::OStream {
 public:
  ExrOutput(const std::string& name, std::FILE* stream) : OStream(name.c_str()), stream_(stream) {}
  void write(const char from[], int count) override {
    if (std::fwrite(from, 1, static_cast<std::size_t>(count), stream_) != static_cast<std::size_t>(count))
      fail();
  }
  /// Whether every byte reached the stream: closing a file swallows what goes wrong then.
  bool whole() const { return fault_.empty(); }
  const std::string& fault() const { return fault_; }
  std::uint64_t tellp() override { return static_cast<std::uint64_t>(std::ftell(stream_)); }
  void seekp(std::uint64_t position) override { std::fseek(stream_, static_cast<long>(position), SEEK_SET); }

 private:
  [[noreturn]] void fail() {
    fault_ = std::generic_category().message(errno);
    throw Iex::IoExc(fault_);
  }

  std::FILE* stream_;
  std::string fault_;
};

/// Has OpenEXR decode and encode on all processors from now on.
inline void use_exr_threads() {
  static const bool once = [] {
    Imf::setGlobalThreadCount(static_cast<int>(std::thread::hardware_concurrency()));
    return true;
  }();
  static_cast<void>(once);
}

}  // namespace sateen::io
