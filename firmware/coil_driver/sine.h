// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stdint.h>

// Sine of an angle [turns / 65536], times 32767; right to 0.4 %.
int16_t sine(uint16_t angle);
