// SPDX-License-Identifier: MIT
#pragma once

#include <cstdarg>
#include <cstdio>
#include <memory>
#include <string>

#include <tiffio.h>

namespace sateen::io {

/// A TIFF on a C stream; libtiff's first complaint since it was last looked at waits in `fault`.
class TiffStream {
 public:
  /// `mode` as TIFFOpen takes it. No more memory than `most` bytes at a time is asked for.
  TiffStream(std::FILE* stream, const std::string& name, const char* mode, tmsize_t most) {
    const std::unique_ptr<TIFFOpenOptions, void (*)(TIFFOpenOptions*)> options(TIFFOpenOptionsAlloc(),
                                                                               TIFFOpenOptionsFree);
    TIFFOpenOptionsSetErrorHandlerExtR(options.get(), remember, this);
    TIFFOpenOptionsSetWarningHandlerExtR(options.get(), ignore, nullptr);
    TIFFOpenOptionsSetMaxSingleMemAlloc(options.get(), most);
    tiff_ = TIFFClientOpenExt(name.c_str(), mode, stream, read, write, seek, leave_open, size, nullptr,
                              nullptr, options.get());
  }
  ~TiffStream() { close(); }
  TiffStream(const TiffStream&) = delete;
  TiffStream& operator=(const TiffStream&) = delete;

  TIFF* get() const { return tiff_; }
  void close() {
    if (tiff_ != nullptr) TIFFClose(tiff_);
    tiff_ = nullptr;
  }
  const std::string& fault() const { return fault_; }

  /// A tag's value, or what it is where the file has none.
  template <class T>
  T tag(ttag_t which, T otherwise) const {
    T value{};
    return TIFFGetFieldDefaulted(tiff_, which, &value) != 0 ? value : otherwise;
  }

 private:
  static int remember(TIFF* /*tiff*/, void* self, const char* /*module*/, const char* format,
                      va_list values) {
    std::string& fault = static_cast<TiffStream*>(self)->fault_;
    char text[256];
    std::vsnprintf(text, sizeof text, format, values);
    if (fault.empty()) fault = text;
    return 1;
  }
  static int ignore(TIFF* /*tiff*/, void* /*self*/, const char* /*module*/, const char* /*format*/,
                    va_list /*values*/) {
    return 1;
  }
  static std::FILE* stream_of(thandle_t handle) { return static_cast<std::FILE*>(handle); }
  static tmsize_t read(thandle_t handle, void* to, tmsize_t count) {
    return static_cast<tmsize_t>(std::fread(to, 1, static_cast<std::size_t>(count), stream_of(handle)));
  }
  static tmsize_t write(thandle_t handle, void* from, tmsize_t count) {
    return static_cast<tmsize_t>(std::fwrite(from, 1, static_cast<std::size_t>(count), stream_of(handle)));
  }
  static toff_t seek(thandle_t handle, toff_t offset, int whence) {
    if (std::fseek(stream_of(handle), static_cast<long>(offset), whence) != 0) return static_cast<toff_t>(-1);
    return static_cast<toff_t>(std::ftell(stream_of(handle)));
  }
  static int leave_open(thandle_t /*handle*/) { return 0; }
  static toff_t size(thandle_t handle) {
    const long at = std::ftell(stream_of(handle));
    std::fseek(stream_of(handle), 0, SEEK_END);
    const auto end = static_cast<toff_t>(std::ftell(stream_of(handle)));
    std::fseek(stream_of(handle), at, SEEK_SET);
    return end;
  }

  TIFF* tiff_ = nullptr;
  std::string fault_;
};

}  // namespace sateen::io
