// SPDX-License-Identifier: MIT
#include "sateen/io/warnings.h"

#include <mutex>
#include <set>
#include <utility>

namespace sateen::io {
namespace {

struct Listener {
  std::mutex mutex;
  WarningHandler handler;
  std::set<std::string> told;
};

Listener& listener() {
  static Listener one;
  return one;
}

}  // namespace

WarningHandler set_warning_handler(WarningHandler handler) {
  const std::scoped_lock lock(listener().mutex);
  listener().told.clear();
  return std::exchange(listener().handler, std::move(handler));
}

void warn(const std::string& text) {
  const std::scoped_lock lock(listener().mutex);
  if (listener().handler && listener().told.insert(text).second) listener().handler(text);
}

}  // namespace sateen::io
