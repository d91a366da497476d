// SPDX-License-Identifier: Apache-2.0
// The emergency stop: a contact between D30 and ground that a press opens, so that a broken wire
// stops too. `make EMERGENCY_STOP=none` for a rig that has another way to cut the amplifiers'
// power.
#pragma once

#include <stdbool.h>

void emergency_begin(void);

// Every millisecond. Open after 2 ms, closed again after 50.
void emergency_tick(void);

// Whether the coils must be off.
bool emergency(void);
