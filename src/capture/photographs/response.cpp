// SPDX-License-Identifier: MIT
#include "sateen/capture/photographs/response.h"

#include <algorithm>
#include <cmath>

#include "sateen/core/colour.h"

namespace sateen::capture {

Response Response::srgb() {
  Response response;
  for (int i = 0; i < 4096; ++i) response.curve.push_back(srgb_decode(static_cast<float>(i) / 4095.0f));
  return response;
}

Response Response::linear() {
  return {{0, 1}};
}

Response Response::gamma(double exponent) {
  Response response;
  for (int i = 0; i < 4096; ++i) {
    response.curve.push_back(static_cast<float>(std::pow(i / 4095.0, exponent)));
  }
  return response;
}

float Response::operator()(float code) const {
  const float at = std::clamp(code, 0.0f, 1.0f) * static_cast<float>(curve.size() - 1);
  const std::size_t i = std::min(static_cast<std::size_t>(at), curve.size() - 2);
  const float f = at - static_cast<float>(i);
  return curve[i] + f * (curve[i + 1] - curve[i]);
}

}  // namespace sateen::capture
