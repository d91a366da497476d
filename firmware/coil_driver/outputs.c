// SPDX-License-Identifier: Apache-2.0
#include "outputs.h"

#include <avr/io.h>
#include <stdlib.h>

#ifndef LIMIT
#define LIMIT FULL_SCALE
#endif
#ifndef SLEW
#define SLEW 100
#endif
#define TOP 799  // 16 MHz / 800 = 20 kHz

static int16_t aims[CHANNELS];
static int16_t now[CHANNELS];

static volatile uint16_t* const widths[CHANNELS] = {&OCR3A, &OCR3B, &OCR3C, &OCR4A, &OCR4B, &OCR4C};
static volatile uint8_t* const controls[CHANNELS] = {&TCCR3A, &TCCR3A, &TCCR3A,
                                                     &TCCR4A, &TCCR4A, &TCCR4A};
static const uint8_t connects[CHANNELS] = {_BV(COM3A1), _BV(COM3B1), _BV(COM3C1),
                                           _BV(COM4A1), _BV(COM4B1), _BV(COM4C1)};

// A width of 0 would still be one pulse of a clock: the pin is taken from the timer instead.
static void put(uint8_t channel, int16_t value) {
  now[channel] = value;
  const uint16_t width = (uint16_t)((uint32_t)abs(value) * TOP / FULL_SCALE);
  *widths[channel] = width;
  if (value < 0)
    PORTA |= (uint8_t)_BV(channel);
  else
    PORTA &= (uint8_t)~_BV(channel);
  if (width)
    *controls[channel] |= connects[channel];
  else
    *controls[channel] &= (uint8_t)~connects[channel];
}

void outputs_begin(void) {
  EICRB = _BV(ISC40) | _BV(ISC50);  // a level at these pins would keep a simulator busy
  PORTA = 0;
  PORTE &= (uint8_t) ~(_BV(PE3) | _BV(PE4) | _BV(PE5));
  PORTH &= (uint8_t) ~(_BV(PH3) | _BV(PH4) | _BV(PH5));
  DDRA = 0x3F;
  DDRE |= _BV(PE3) | _BV(PE4) | _BV(PE5);
  DDRH |= _BV(PH3) | _BV(PH4) | _BV(PH5);
  ICR3 = ICR4 = TOP;
  TCCR3A = TCCR4A = _BV(WGM31);
  TCCR3B = TCCR4B = _BV(WGM33) | _BV(WGM32) | _BV(CS30);
  outputs_off();
}

uint8_t outputs_aim(const int16_t aim[CHANNELS]) {
  int16_t most = 0;
  uint8_t beyond = 0;
  for (uint8_t c = 0; c < CHANNELS; ++c) {
    const int16_t size = aim[c] < 0 ? (aim[c] == INT16_MIN ? INT16_MAX : -aim[c]) : aim[c];
    if (size > LIMIT) beyond |= (uint8_t)_BV(c);
    if (size > most) most = size;
  }
  for (uint8_t c = 0; c < CHANNELS; ++c)
    aims[c] = beyond ? (int16_t)((int32_t)aim[c] * LIMIT / most) : aim[c];
  for (uint8_t c = 0; c < CHANNELS; ++c) {
    if (aims[c] > LIMIT) aims[c] = LIMIT;
    if (aims[c] < -LIMIT) aims[c] = -LIMIT;
  }
  return beyond;
}

void outputs_off(void) {
  for (uint8_t c = 0; c < CHANNELS; ++c) {
    aims[c] = 0;
    put(c, 0);
  }
}

void outputs_tick(void) {
  for (uint8_t c = 0; c < CHANNELS; ++c) {
    int16_t step = aims[c] - now[c];
    if (step > SLEW) step = SLEW;
    if (step < -SLEW) step = -SLEW;
    if (step) put(c, now[c] + step);
  }
}

int16_t output(uint8_t channel) { return now[channel]; }
