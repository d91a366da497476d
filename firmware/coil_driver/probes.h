// SPDX-License-Identifier: Apache-2.0
// Temperatures of the coils by PT1000 probes, each from an analog input to ground, with a resistor
// of PROBE_OHMS from 5 V to the input:
//   channel   1   2   3   4   5   6
//   input    A0  A1  A2  A3  A4  A5
// `make PROBES=1,1,1,0,0,0` says which channels have one. With MAX_DEGC the coils are off while one
// of them is warmer, or its probe is open or shorted.
#pragma once

#include <stdint.h>

#include "protocol.h"

// Takes the first averages, in 7 ms a probe.
void probes_begin(void);

// Every millisecond: one reading of one probe. Never waits.
void probes_tick(void);

// Mean of 64 readings [0.1 °C], or a mark.
int16_t probes_at(uint8_t channel);

// Why the coils must be off; trip_none if they need not.
uint8_t probes_trip(void);
