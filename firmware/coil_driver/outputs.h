// SPDX-License-Identifier: Apache-2.0
// Six outputs, each a pulse width and a direction, of a Mega 2560:
//   channel     1   2   3   4   5   6
//   width      D5  D2  D3  D6  D7  D8   20 kHz
//   direction D22 D23 D24 D25 D26 D27   high when negative
#pragma once

#include <stdbool.h>
#include <stdint.h>

#include "protocol.h"

// All off.
void outputs_begin(void);

// Where the outputs are to go [per mille], reached by at most SLEW a millisecond. Beyond LIMIT all
// are scaled by the same factor; then it returns a bit for each channel that was beyond, else 0.
uint8_t outputs_aim(const int16_t aim[CHANNELS]);

// Off at once.
void outputs_off(void);

// Every millisecond.
void outputs_tick(void);

int16_t output(uint8_t channel);
