// SPDX-License-Identifier: Apache-2.0
#include "emergency.h"

#include <avr/io.h>
#include <stdint.h>
#include <util/delay.h>

#define OPEN_AFTER 2     // [ms]
#define CLOSED_AFTER 50  // [ms]

#ifdef NO_EMERGENCY_STOP

void emergency_begin(void) {}
void emergency_tick(void) {}
bool emergency(void) { return false; }

#else

static bool open;
static uint8_t differs;  // [ms]

void emergency_begin(void) {
  PORTC |= _BV(PC7);  // pull-up
  _delay_us(50);
  open = PINC & _BV(PC7);
}

void emergency_tick(void) {
  const bool is_open = PINC & _BV(PC7);
  if (is_open == open) {
    differs = 0;
    return;
  }
  if (++differs < (is_open ? OPEN_AFTER : CLOSED_AFTER)) return;
  open = is_open;
  differs = 0;
}

bool emergency(void) { return open; }

#endif
