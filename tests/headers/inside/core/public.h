// SPDX-License-Identifier: MIT
// Wrong on purpose: includes what is not public.
#pragma once
#include "sateen/core/inside.h"
