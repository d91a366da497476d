// SPDX-License-Identifier: Apache-2.0
// What goes over the wire: docs/reference/protocol.md.
#pragma once

#include <stdbool.h>
#include <stdint.h>

#define PROTOCOL_VERSION 1
#define CHANNELS 6
#define FULL_SCALE 1000    // of an output: per mille
#define WATCHDOG_MS 100    // without a valid message
#define LONGEST_PACKET 40  // decoded, with its check sum
#define LONGEST_FRAME 44   // as sent, with its end

enum MessageType { message_hello = 1, message_arm, message_set, message_stop, message_status };
enum { message_started = 7, reply_bit = 0x80 };  // started: sent unasked, once

enum Result {
  result_ok,
  result_limited,  // scaled to this device's limits
  result_not_armed,
  result_stale,  // older than what was last set
  result_bad_length,
  result_unknown,
  result_wrong_version
};

enum State { state_idle, state_armed, state_tripped, state_stopped };

// CRC-16/CCITT-FALSE.
uint16_t crc16(const uint8_t* bytes, uint8_t length);

// A frame without its end becomes a packet, in place; its length, 0 when it is not a frame.
uint8_t decode_frame(uint8_t* bytes, uint8_t length);

// A packet becomes a frame with its end; returns its length.
uint8_t encode_frame(const uint8_t* packet, uint8_t length, uint8_t* frame);
