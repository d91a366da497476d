// SPDX-License-Identifier: Apache-2.0
// Drives the coils of a rig by what the host says, and turns them off when it says nothing.
#include <avr/interrupt.h>
#include <avr/io.h>
#include <avr/sleep.h>
#include <avr/wdt.h>
#include <util/atomic.h>

#include "outputs.h"
#include "protocol.h"
#include "serial.h"

static volatile uint16_t milliseconds;

ISR(TIMER0_COMPA_vect) { ++milliseconds; }

static uint16_t now_ms(void) {
  uint16_t now;
  ATOMIC_BLOCK(ATOMIC_RESTORESTATE) { now = milliseconds; }
  return now;
}

static uint8_t state = state_idle;
static uint8_t last_set;     // sequence number
static uint16_t last_valid;  // [ms]
static uint16_t good, bad, trips;

static uint8_t put_u16(uint8_t* to, uint16_t value) {
  to[0] = (uint8_t)value;
  to[1] = (uint8_t)(value >> 8);
  return 2;
}

static void reply(uint8_t type, uint8_t sequence, uint8_t result, uint8_t limited) {
  uint8_t packet[LONGEST_PACKET];
  uint8_t frame[LONGEST_FRAME];
  uint8_t n = 0;
  packet[n++] = type | reply_bit;
  packet[n++] = sequence;
  packet[n++] = PROTOCOL_VERSION;
  packet[n++] = result;
  packet[n++] = state;
  packet[n++] = limited;
  n += put_u16(packet + n, good);
  n += put_u16(packet + n, bad);
  n += put_u16(packet + n, trips);
  for (uint8_t c = 0; c < CHANNELS; ++c) n += put_u16(packet + n, (uint16_t)output(c));
  n += put_u16(packet + n, crc16(packet, n));
  const uint8_t length = encode_frame(packet, n, frame);
  for (uint8_t k = 0; k < length; ++k) serial_put(frame[k]);
}

static void turn_off(uint8_t why) {
  outputs_off();
  state = why;
}

static uint8_t set(uint8_t sequence, const uint8_t* payload, uint8_t* limited) {
  if (state != state_armed) return result_not_armed;
  const int8_t ahead = (int8_t)(sequence - last_set);
  if (ahead < 0) return result_stale;
  if (ahead == 0) return result_ok;  // again: its answer was lost
  last_set = sequence;
  int16_t aim[CHANNELS];
  for (uint8_t c = 0; c < CHANNELS; ++c)
    aim[c] = (int16_t)(payload[2 * c] | (uint16_t)payload[2 * c + 1] << 8);
  *limited = outputs_aim(aim);
  return *limited ? result_limited : result_ok;
}

static void obey(const uint8_t* packet, uint8_t length) {
  const uint8_t type = packet[0], sequence = packet[1];
  const uint8_t* payload = packet + 2;
  const uint8_t size = (uint8_t)(length - 2);
  uint8_t result = result_ok, limited = 0;
  switch (type) {
    case message_hello:
      if (size != 1)
        result = result_bad_length;
      else if (payload[0] != PROTOCOL_VERSION)
        result = result_wrong_version;
      break;
    case message_arm:
      if (size != 0) {
        result = result_bad_length;
        break;
      }
      outputs_off();
      last_set = sequence;
      state = state_armed;
      break;
    case message_set:
      result = size == 2 * CHANNELS ? set(sequence, payload, &limited) : result_bad_length;
      break;
    case message_stop:
      turn_off(state_stopped);
      break;
    case message_status:
      break;
    default:
      result = result_unknown;
  }
  reply(type, sequence, result, limited);
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
    last_valid = now_ms();
    obey(frame, size - 2);
    return;  // so that the outputs are looked after between two messages
  }
}

int main(void) {
  MCUSR = 0;
  wdt_disable();
  outputs_begin();
  serial_begin();
  TCCR0A = _BV(WGM01);
  TCCR0B = _BV(CS01) | _BV(CS00);
  OCR0A = 249;  // 16 MHz / 64 / 250 = 1 kHz
  TIMSK0 = _BV(OCIE0A);
  wdt_enable(WDTO_120MS);  // should this program itself hang, the reset turns the outputs off
  sei();
  reply(message_started, 0, result_ok, 0);
  uint16_t ticked = 0;
  for (;;) {
    sleep_mode();  // till a byte or a millisecond comes
    wdt_reset();
    listen();
    const uint16_t now = now_ms();
    if (now != ticked) {
      ticked = now;
      if (state == state_armed) outputs_tick();
    }
    if (state == state_armed && (uint16_t)(now - last_valid) >= WATCHDOG_MS) {
      ++trips;
      turn_off(state_tripped);
    }
  }
}
