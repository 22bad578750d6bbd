// SPDX-License-Identifier: MIT
#include "sateen/core/error.h"

#include <new>

namespace sateen {

std::string failure_of(const std::string& name, const std::function<void()>& work) {
  try {
    work();
    return "";
  } catch (const Error& error) {
    return error.what();
  } catch (const std::bad_alloc&) {
    return name + ": needs more memory than there is";
  } catch (const std::exception& error) {
    return name + ": unexpected failure, please report it: " + error.what();
  } catch (...) {
    return name + ": unexpected failure, please report it";
  }
}

}  // namespace sateen
