// SPDX-License-Identifier: MIT
#pragma once

#include "sateen/render/renderer.h"

namespace sateen::render {

/// automatic_exposure (core/exposure.h) of what the view shows, from a small picture of the proportions of
/// `settings`. A turntable is metered once, on its first picture, and keeps the exposure: it would flicker.
double metered_exposure(const Renderer& renderer, const scene::View& view, const PictureSettings& settings);

}  // namespace sateen::render
