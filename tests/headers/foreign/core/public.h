// SPDX-License-Identifier: MIT
// Wrong on purpose: includes a header of another library.
#pragma once
#include <opencv2/core.hpp>
