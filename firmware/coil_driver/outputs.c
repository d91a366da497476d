// SPDX-License-Identifier: Apache-2.0
#include "outputs.h"

#include <avr/io.h>
#include <stdlib.h>
#include <string.h>
#include <util/atomic.h>

#include "sine.h"

#define TOP 799                      // 16 MHz / 800 = 20 kHz
#define WIDTH_OF_FULL_SCALE 52364UL  // 65536 · TOP / FULL_SCALE
#define ENABLE PA6
#define UNSCALED 32768U
#define SLEW_PER_TICK ((SLEW) / TICKS_PER_MS)

#if (SLEW) < TICKS_PER_MS || (SLEW) > 255
#error SLEW is not between 4 and 255
#endif

#define ARE_SHARES(a, b, c, d, e, f) \
  (IS_SHARE(a) && IS_SHARE(b) && IS_SHARE(c) && IS_SHARE(d) && IS_SHARE(e) && IS_SHARE(f))
#define IS_SHARE(limit) ((limit) >= 0 && (limit) <= FULL_SCALE)
#define ARE_SHARES_OF(...) ARE_SHARES(__VA_ARGS__)
_Static_assert(ARE_SHARES_OF(LIMITS), "LIMITS are not six of 0 to 1000");

static const int16_t limits[CHANNELS] = {LIMITS};

static Waveform followed, next;
static volatile bool fresh;   // next is to be followed
static bool turning;          // since it was enabled: the phase goes on
static uint32_t phase, step;  // [turns / 2^32], and by so much a tick
static uint32_t next_step;
static int16_t rest[CHANNELS];                    // outputs less what they follow
static int16_t now[CHANNELS], planned[CHANNELS];  // planned: at the next tick
static uint16_t angle_now;                        // [turns / 65536] that `now` belongs to

static volatile uint16_t* const widths[CHANNELS] = {&OCR3A, &OCR3B, &OCR3C, &OCR4A, &OCR4B, &OCR4C};
static volatile uint8_t* const controls[CHANNELS] = {&TCCR3A, &TCCR3A, &TCCR3A,
                                                     &TCCR4A, &TCCR4A, &TCCR4A};
static const uint8_t connects[CHANNELS] = {_BV(COM3A1), _BV(COM3B1), _BV(COM3C1),
                                           _BV(COM4A1), _BV(COM4B1), _BV(COM4C1)};

// A width of 0 would still be one pulse of a clock: the pin is taken from the timer instead.
static void put(uint8_t channel, int16_t value) {
  now[channel] = value;
  const uint16_t width = (uint16_t)((uint16_t)abs(value) * WIDTH_OF_FULL_SCALE >> 16);
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
  DDRA = 0x3F | _BV(ENABLE);
  DDRE |= _BV(PE3) | _BV(PE4) | _BV(PE5);
  DDRH |= _BV(PH3) | _BV(PH4) | _BV(PH5);
  ICR3 = ICR4 = TOP;
  TCCR3A = TCCR4A = _BV(WGM31);
  TCCR3B = TCCR4B = _BV(WGM33) | _BV(WGM32) | _BV(CS30);
  outputs_off();
}

void outputs_enable(void) {
  outputs_off();
  PORTA |= _BV(ENABLE);
}

void outputs_off(void) {
  ATOMIC_BLOCK(ATOMIC_RESTORESTATE) {
    PORTA &= (uint8_t)~_BV(ENABLE);
    fresh = turning = false;
    step = 0;
    memset(&followed, 0, sizeof followed);
    memset(rest, 0, sizeof rest);
    memset(planned, 0, sizeof planned);
    for (uint8_t c = 0; c < CHANNELS; ++c) put(c, 0);
  }
}

// Rounded up.
static uint16_t root(uint32_t square) {
  uint16_t r = 0;
  for (uint16_t bit = 1U << 15; bit; bit >>= 1)
    if ((uint32_t)(r | bit) * (r | bit) <= square) r |= bit;
  return (uint32_t)r * r < square ? r + 1 : r;
}

static uint16_t size(int16_t value) { return value < 0 ? -(uint16_t)value : (uint16_t)value; }

static uint32_t square(int16_t value) { return (uint32_t)size(value) * size(value); }

static void scale_by(int16_t values[CHANNELS], uint16_t scale) {
  for (uint8_t c = 0; c < CHANNELS; ++c)
    values[c] = (int16_t)((int32_t)values[c] * (int32_t)scale / (int32_t)UNSCALED);
}

uint8_t outputs_aim(Waveform* aim, uint16_t begin, uint16_t* scale) {
  uint8_t beyond = 0;
  *scale = UNSCALED;
  bool turns = false;
  for (uint8_t c = 0; c < CHANNELS; ++c) {
    turns = turns || aim->cosine[c] || aim->sine[c];
    const uint32_t most =
        (uint32_t)size(aim->constant[c]) + root(square(aim->cosine[c]) + square(aim->sine[c]));
    if (most <= (uint16_t)limits[c]) continue;
    beyond |= (uint8_t)_BV(c);
    const uint16_t share = (uint16_t)((uint32_t)limits[c] * UNSCALED / most);
    if (share < *scale) *scale = share;
  }
  if (beyond) {
    scale_by(aim->constant, *scale);
    scale_by(aim->cosine, *scale);
    scale_by(aim->sine, *scale);
  }
  // 2^32 / (4000 · 1000) to a mHz is 1073 + 0.741824
  const uint32_t f = (uint32_t)labs(aim->frequency);
  const uint32_t by = f * 1073 + f * 742 / 1000;
  fresh = false;  // so that the interrupt leaves `next` alone
  next = *aim;
  ATOMIC_BLOCK(ATOMIC_RESTORESTATE) {
    next_step = aim->frequency < 0 ? -by : by;
    if (turns && !turning) phase = (uint32_t)begin << 16;
    turning = turning || turns;
    fresh = true;
  }
  return beyond;
}

static int16_t value_of(const Waveform* aim, uint8_t c, int16_t cosine, int16_t sine_) {
  int16_t value = aim->constant[c];
  if (!turning) return value;
  const int32_t turned = (int32_t)aim->cosine[c] * cosine + (int32_t)aim->sine[c] * sine_;
  return value + (int16_t)((uint32_t)(2 * turned) >> 16);
}

// Puts out what the last tick computed, so that all channels change at the same time, and computes.
void outputs_tick(void) {
  for (uint8_t c = 0; c < CHANNELS; ++c) put(c, planned[c]);
  angle_now = (uint16_t)(phase >> 16);
  phase += step;
  const uint16_t angle = (uint16_t)(phase >> 16);
  const int16_t cosine = sine(angle + 16384), sine_ = sine(angle);
  if (fresh) {  // what changes is the aim, not the outputs
    for (uint8_t c = 0; c < CHANNELS; ++c)
      rest[c] += value_of(&followed, c, cosine, sine_) - value_of(&next, c, cosine, sine_);
    followed = next;
    step = next_step;
    fresh = false;
  }
  for (uint8_t c = 0; c < CHANNELS; ++c) {
    int16_t left = rest[c];
    if (left > SLEW_PER_TICK)
      left -= SLEW_PER_TICK;
    else if (left < -SLEW_PER_TICK)
      left += SLEW_PER_TICK;
    else
      left = 0;
    rest[c] = left;
    int16_t value = value_of(&followed, c, cosine, sine_) + left;
    if (value > limits[c]) value = limits[c];
    if (value < -limits[c]) value = -limits[c];
    planned[c] = value;
  }
}

void outputs_now(int16_t outputs[CHANNELS], uint16_t* angle) {
  ATOMIC_BLOCK(ATOMIC_RESTORESTATE) {
    memcpy(outputs, now, sizeof now);
    *angle = angle_now;
  }
}
