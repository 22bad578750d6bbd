// SPDX-License-Identifier: MIT
#pragma once
#include "sateen/core/image.h"
