// SPDX-License-Identifier: Apache-2.0
#include "probes.h"

#include <avr/io.h>
#include <stdbool.h>

#ifndef PROBES

#ifdef MAX_DEGC
#error MAX_DEGC needs PROBES
#endif

void probes_begin(void) {}
void probes_tick(void) {}
int16_t probes_at(uint8_t channel) {
  (void)channel;
  return probe_none;
}
uint8_t probes_trip(void) { return trip_none; }

#else

#ifndef PROBE_OHMS
#define PROBE_OHMS 2200
#endif
#define ANY(a, b, c, d, e, f) ((a) || (b) || (c) || (d) || (e) || (f))
#define ANY_OF(...) ANY(__VA_ARGS__)
#if !ANY_OF(PROBES)
#error PROBES names no channel
#endif
#if (PROBE_OHMS) < 500 || (PROBE_OHMS) > 6000
#error PROBE_OHMS is not between 500 and 6000
#endif
#if defined MAX_DEGC && ((MAX_DEGC) < 0 || (MAX_DEGC) > 240)
#error MAX_DEGC is not between 0 and 240
#endif

#define READINGS 64U    // of a mean
#define SCALE 65536UL   // READINGS times the 1024 steps of a reading
#define COOLER 50       // [0.1 °C] below the limit, before the coils may be on again
#define COLDEST (-500)  // [0.1 °C] of the table
#define STEP 250        // [0.1 °C] of the table
#define CONVERTER (_BV(ADEN) | _BV(ADPS2) | _BV(ADPS1) | _BV(ADPS0))  // 125 kHz

static const uint8_t fitted[CHANNELS] = {PROBES};

// Resistance of a PT1000 [0.1 Ω] from -50 to 250 °C (IEC 60751); between them straight to 0.02 °C.
static const uint16_t table[] = {8031,  9019,  10000, 10973, 11940, 12899, 13851,
                                 14795, 15733, 16663, 17586, 18501, 19410};
#define ROWS (sizeof table / sizeof *table)

static int16_t means[CHANNELS];
static uint8_t channel;  // that is read
static uint16_t sum;
static uint8_t readings;

static void start(void) {
  ADMUX = _BV(REFS0) | channel;  // the reference is the supply, which also feeds the probes
  ADCSRA = CONVERTER | _BV(ADSC);
}

static void select(uint8_t from) {
  channel = from;
  while (!fitted[channel]) channel = (uint8_t)(channel + 1) % CHANNELS;
  sum = 0;
  readings = 0;
  start();
}

static int16_t temperature_of(uint16_t sum_of_readings) {
  const uint32_t share = sum_of_readings + READINGS / 2;  // the middle of a step
  const uint32_t resistance = 10UL * share * (PROBE_OHMS) / (SCALE - share);
  if (resistance < table[0]) return probe_shorted;
  if (resistance > table[ROWS - 1]) return probe_open;
  uint8_t row = 0;
  while (row + 2U < ROWS && resistance > table[row + 1]) ++row;
  const uint16_t above = (uint16_t)resistance - table[row];
  return COLDEST + STEP * row +
         (int16_t)((uint32_t)above * STEP / (uint16_t)(table[row + 1] - table[row]));
}

#ifdef MAX_DEGC
#define HOTTEST (10 * (MAX_DEGC))  // [0.1 °C]

static bool hot[CHANNELS];

static bool is_mark(int16_t mean) { return mean == probe_open || mean == probe_shorted; }

static void compare(int16_t mean) {
  if (is_mark(mean)) return;
  if (mean > HOTTEST)
    hot[channel] = true;
  else if (mean < HOTTEST - COOLER)
    hot[channel] = false;
}

uint8_t probes_trip(void) {
  for (uint8_t c = 0; c < CHANNELS; ++c) {
    if (is_mark(means[c])) return trip_probe;
    if (hot[c]) return trip_hot;
  }
  return trip_none;
}

#else

static void compare(int16_t mean) { (void)mean; }
uint8_t probes_trip(void) { return trip_none; }

#endif

// Whether that was the last reading of a mean.
static bool add_reading(void) {
  sum += ADC;
  if (++readings < READINGS) {
    start();
    return false;
  }
  means[channel] = temperature_of(sum);
  compare(means[channel]);
  select((uint8_t)(channel + 1) % CHANNELS);
  return true;
}

void probes_begin(void) {
  uint8_t count = 0;
  for (uint8_t c = 0; c < CHANNELS; ++c) {
    means[c] = probe_none;
    if (!fitted[c]) continue;
    ++count;
    DIDR0 |= (uint8_t)_BV(c);
  }
  select(0);
  while (count) {
    while (ADCSRA & _BV(ADSC)) {
    }
    if (add_reading()) --count;
  }
}

void probes_tick(void) {
  if (!(ADCSRA & _BV(ADSC))) add_reading();
}

int16_t probes_at(uint8_t c) { return means[c]; }

#endif
