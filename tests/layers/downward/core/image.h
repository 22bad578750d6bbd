// SPDX-License-Identifier: MIT
#pragma once
#include "sateen/io/file.h"
