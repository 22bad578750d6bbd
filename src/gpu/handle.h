// SPDX-License-Identifier: MIT
#pragma once

#include <utility>

namespace sateen::gpu {

/// Owns one OpenGL name and gives it back; movable. The context it was made in must be current then.
class Handle {
 public:
  using Destroy = void (*)(unsigned name);

  Handle() = default;
  Handle(unsigned name, Destroy destroy) : name_(name), destroy_(destroy) {}
  ~Handle() { reset(); }
  Handle(Handle&& other) noexcept
      : name_(std::exchange(other.name_, 0)), destroy_(std::exchange(other.destroy_, nullptr)) {}
  Handle& operator=(Handle&& other) noexcept {
    if (this != &other) {
      reset();
      name_ = std::exchange(other.name_, 0);
      destroy_ = std::exchange(other.destroy_, nullptr);
    }
    return *this;
  }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;

  unsigned name() const { return name_; }

 private:
  void reset() {
    if (destroy_ != nullptr) destroy_(name_);
    destroy_ = nullptr;
    name_ = 0;
  }

  unsigned name_ = 0;
  Destroy destroy_ = nullptr;
};

}  // namespace sateen::gpu
