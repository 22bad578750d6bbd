// SPDX-License-Identifier: MIT
#pragma once

namespace sateen::io {

/// How a picture that is written stores its samples; PNG takes the integers, EXR the floats.
enum class RowSamples { u8, u16, f16, f32 };

}  // namespace sateen::io
