// SPDX-License-Identifier: MIT
#include "sateen/capture/capture.h"
