// SPDX-License-Identifier: Apache-2.0
// Drives the coils of a rig by what the host says, and turns them off when it says nothing.
#include <avr/interrupt.h>
#include <avr/io.h>
#include <avr/sleep.h>
#include <avr/wdt.h>
#include <string.h>
#include <util/atomic.h>

#include "emergency.h"
#include "outputs.h"
#include "probes.h"
#include "protocol.h"
#include "serial.h"

static volatile uint16_t milliseconds;

static volatile bool driving;

ISR(TIMER1_COMPA_vect) {
  static uint8_t ticks;
  if (++ticks == TICKS_PER_MS) {
    ticks = 0;
    ++milliseconds;
  }
  if (driving) outputs_tick();
}

static uint16_t now_ms(void) {
  uint16_t now;
  ATOMIC_BLOCK(ATOMIC_RESTORESTATE) { now = milliseconds; }
  return now;
}

static uint8_t reset_cause;  // MCUSR
static uint8_t state = state_idle;
static uint8_t trip = trip_none;
static uint8_t last_set;      // sequence number
static uint16_t last_obeyed;  // [ms]
static uint16_t good, bad, trips;
static Waveform aim;  // as followed
static uint16_t scale = 32768;
static uint8_t limited;  // a bit for each channel
static uint8_t shown;    // channel whose temperature the next answer has

static uint8_t put_u16(uint8_t* to, uint16_t value) {
  to[0] = (uint8_t)value;
  to[1] = (uint8_t)(value >> 8);
  return 2;
}

static uint16_t u16_at(const uint8_t* from) { return from[0] | (uint16_t)from[1] << 8; }

static void reply(uint8_t type, uint8_t sequence, uint8_t result) {
  uint8_t packet[LONGEST_PACKET];
  uint8_t frame[LONGEST_FRAME];
  int16_t outputs[CHANNELS];
  uint16_t phase;
  uint8_t n = 0;
  outputs_now(outputs, &phase);
  packet[n++] = type | reply_bit;
  packet[n++] = sequence;
  packet[n++] = PROTOCOL_VERSION;
  packet[n++] = result;
  packet[n++] = state;
  packet[n++] = limited;
  n += put_u16(packet + n, good);
  n += put_u16(packet + n, bad);
  n += put_u16(packet + n, trips);
  for (uint8_t c = 0; c < CHANNELS; ++c) n += put_u16(packet + n, (uint16_t)outputs[c]);
  if (result != result_wrong_version) {
    n += put_u16(packet + n, now_ms());
    packet[n++] = reset_cause;
    packet[n++] = trip | (emergency() ? trip_open_now : 0);
    packet[n++] = (SLEW);
    n += put_u16(packet + n, scale);
    n += put_u16(packet + n, crc16((const uint8_t*)&aim, sizeof aim));
    n += put_u16(packet + n, phase);
    packet[n++] = shown;
    n += put_u16(packet + n, (uint16_t)probes_at(shown));
    shown = (uint8_t)(shown + 1) % CHANNELS;
  }
  n += put_u16(packet + n, crc16(packet, n));
  serial_send(frame, encode_frame(packet, n, frame));
}

static void turn_off(uint8_t to_state, uint8_t why) {
  driving = false;
  outputs_off();
  memset(&aim, 0, sizeof aim);
  scale = 32768;
  limited = 0;
  state = to_state;
  trip = why;
}

// Why the outputs must stay off.
static uint8_t obstacle(void) { return emergency() ? trip_emergency : probes_trip(); }

static uint8_t arm(uint8_t sequence) {
  const uint8_t why = obstacle();
  turn_off(why ? state_tripped : state_idle, why);
  if (why) return result_not_armed;
  outputs_enable();
  last_set = sequence;
  last_obeyed = now_ms();
  state = state_armed;
  driving = true;
  return result_ok;
}

// Of a message that sets outputs: whether it is to be obeyed.
static uint8_t admit(uint8_t sequence, uint16_t deadline, bool* again) {
  if (state != state_armed) return result_not_armed;
  const int8_t ahead = (int8_t)(sequence - last_set);
  *again = ahead == 0;  // its answer was lost
  if (*again) return result_ok;
  if (ahead < 0 || (int16_t)(now_ms() - deadline) > 0) return result_stale;
  return result_ok;
}

static void take(const uint8_t* payload, int16_t to[CHANNELS]) {
  for (uint8_t c = 0; c < CHANNELS; ++c) to[c] = (int16_t)u16_at(payload + 2 * c);
}

// A set or a waveform. Only one that is obeyed keeps the watchdog from its trip.
static uint8_t set(uint8_t sequence, const uint8_t* payload, bool waveform) {
  bool again = false;
  Waveform wanted = {0};
  uint16_t begin = 0;
  const uint8_t result = admit(sequence, u16_at(payload), &again);
  if (result != result_ok) return result;
  if (again) return limited ? result_limited : result_ok;
  payload += 2;
  if (waveform) {
    begin = u16_at(payload);
    wanted.frequency = (int32_t)(u16_at(payload + 2) | (uint32_t)u16_at(payload + 4) << 16);
    if (wanted.frequency > MAX_FREQUENCY || wanted.frequency < -MAX_FREQUENCY)
      return result_out_of_range;
    payload += 6;
    take(payload + 2 * CHANNELS, wanted.cosine);
    take(payload + 4 * CHANNELS, wanted.sine);
  }
  take(payload, wanted.constant);
  last_set = sequence;
  last_obeyed = now_ms();
  aim = wanted;
  limited = outputs_aim(&aim, begin, &scale);
  return limited ? result_limited : result_ok;
}

static void obey(const uint8_t* packet, uint8_t length) {
  const uint8_t type = packet[0], sequence = packet[1];
  const uint8_t* payload = packet + 2;
  const uint8_t size = (uint8_t)(length - 2);
  uint8_t result = result_ok;
  switch (type) {
    case message_hello:
      if (size != 1)
        result = result_bad_length;
      else if (payload[0] != PROTOCOL_VERSION)
        result = result_wrong_version;
      if (state == state_armed) turn_off(state_idle, trip_none);  // another host begins
      break;
    case message_arm:
      result = size == 0 ? arm(sequence) : result_bad_length;
      break;
    case message_set:
      result = size == 2 + 2 * CHANNELS ? set(sequence, payload, false) : result_bad_length;
      break;
    case message_waveform:
      result = size == 8 + 6 * CHANNELS ? set(sequence, payload, true) : result_bad_length;
      break;
    case message_stop:
      turn_off(state_stopped, trip_none);
      break;
    case message_status:
      break;
    default:
      result = result_unknown;
  }
  reply(type, sequence, result);
}

// A frame ends with 0. What is too long to be one is passed over up to its end.
static void listen(void) {
  static uint8_t frame[LONGEST_FRAME];
  static uint8_t length;
  uint8_t byte;
  while (serial_get(&byte)) {
    if (byte) {
      if (length < LONGEST_FRAME) frame[length++] = byte;
      continue;
    }
    if (length == 0) continue;
    const uint8_t size = length < LONGEST_FRAME ? decode_frame(frame, length) : 0;
    length = 0;
    if (size < 4 || crc16(frame, size - 2) != (frame[size - 2] | (uint16_t)frame[size - 1] << 8)) {
      ++bad;
      continue;
    }
    ++good;
    obey(frame, size - 2);
    return;  // so that the outputs are looked after between two messages
  }
}

// Every millisecond.
static void watch(uint16_t now) {
  emergency_tick();
  probes_tick();
  const uint8_t why = obstacle();
  if (why && state != state_tripped) turn_off(state_tripped, why);
  if (state == state_armed && (uint16_t)(now - last_obeyed) >= WATCHDOG_MS) {
    ++trips;
    turn_off(state_tripped, trip_silence);
  }
}

int main(void) {
  reset_cause = MCUSR;
  MCUSR = 0;
  wdt_disable();
  outputs_begin();
  emergency_begin();
  probes_begin();
  serial_begin();
  TCCR1B = _BV(WGM12) | _BV(CS10);
  OCR1A = F_CPU / 1000 / TICKS_PER_MS - 1;
  TIMSK1 = _BV(OCIE1A);
  wdt_enable(WDTO_120MS);  // should this program itself hang, the reset turns the outputs off
  sei();
  reply(message_started, 0, result_ok);
  uint16_t watched = 0;
  for (;;) {
    sleep_mode();  // till a byte or a tick comes
    wdt_reset();
    listen();
    const uint16_t now = now_ms();
    if (now != watched) {
      watched = now;
      watch(now);
    }
  }
}
