// SPDX-License-Identifier: Apache-2.0
// Six outputs, each a pulse width and a direction, of a Mega 2560, and one that enables amplifiers:
//   channel     1   2   3   4   5   6
//   width      D5  D2  D3  D6  D7  D8   20 kHz
//   direction D22 D23 D24 D25 D26 D27   high when negative
//   enable    D28                       high while armed
#pragma once

#include <stdbool.h>
#include <stdint.h>

#include "protocol.h"

#define TICKS_PER_MS 4  // at which outputs are renewed
#ifndef LIMITS          // of each channel [per mille]
#define LIMITS FULL_SCALE, FULL_SCALE, FULL_SCALE, FULL_SCALE, FULL_SCALE, FULL_SCALE
#endif
#ifndef SLEW  // [per mille a millisecond]
#define SLEW 100
#endif

// All off and disabled.
void outputs_begin(void);

// Enables the amplifiers, with all outputs at 0.
void outputs_enable(void);

// Off and disabled at once.
void outputs_off(void);

// What the outputs are to follow from the next tick on. They come to it without a step, by SLEW at
// most beside the waveform's own slope. A waveform that turns goes on at its phase; one that begins
// does so at `phase` [turns / 65536]. Where a channel would be beyond its limit, all of `aim` is
// scaled by the same factor, `scale` [1 / 32768]. Returns a bit for each such channel.
uint8_t outputs_aim(Waveform* aim, uint16_t phase, uint16_t* scale);

// In an interrupt, TICKS_PER_MS times a millisecond.
void outputs_tick(void);

// The outputs now [per mille] and the phase that they belong to.
void outputs_now(int16_t outputs[CHANNELS], uint16_t* phase);
