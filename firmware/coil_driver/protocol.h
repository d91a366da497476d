// SPDX-License-Identifier: Apache-2.0
// What goes over the wire: docs/reference/protocol.md.
#pragma once

#include <stdbool.h>
#include <stdint.h>

#define PROTOCOL_VERSION 3
#define CHANNELS 6
#define FULL_SCALE 1000       // of an output: per mille
#define MAX_FREQUENCY 500000  // of a waveform [mHz]
#define WATCHDOG_MS 100       // without an obeyed set or waveform
#define LONGEST_PACKET 48     // decoded, with its check sum
#define LONGEST_FRAME 52      // as sent, with its end
#define FORMER_REPLY 24       // bytes of a reply of version 1 without its check sum

enum MessageType {
  message_hello = 1,
  message_arm,
  message_set,
  message_stop,
  message_status,
  message_waveform,
  message_started  // sent by the device unasked, once
};
enum { reply_bit = 0x80 };

enum Result {
  result_ok,
  result_limited,    // scaled to this device's limits
  result_not_armed,  // or refuses to be armed
  result_stale,      // older than what was last set, or past its deadline
  result_bad_length,
  result_unknown,
  result_wrong_version,
  result_out_of_range  // a frequency
};

enum State { state_idle, state_armed, state_tripped, state_stopped };

// Why the state is tripped, and a bit that is set while the emergency stop is open.
enum Trip {
  trip_none,
  trip_silence,
  trip_emergency,
  trip_hot,    // a probe shows more than MAX_DEGC
  trip_probe,  // a probe shows nothing, with MAX_DEGC
  trip_open_now = 0x80
};

// In place of a temperature.
enum Probe { probe_none = -32768, probe_shorted = -32767, probe_open = 32767 };

// Outputs as functions of the phase φ: constant + cosine cos φ + sine sin φ [per mille], φ turning
// at `frequency` [mHz]. Without cosine and sine it is what a set asks for.
typedef struct {
  int32_t frequency;
  int16_t constant[CHANNELS], cosine[CHANNELS], sine[CHANNELS];
} Waveform;

// CRC-16/CCITT-FALSE.
uint16_t crc16(const uint8_t* bytes, uint8_t length);

// A frame without its end becomes a packet, in place; its length, 0 when it is not a frame.
uint8_t decode_frame(uint8_t* bytes, uint8_t length);

// A packet becomes a frame with its end; returns its length.
uint8_t encode_frame(const uint8_t* packet, uint8_t length, uint8_t* frame);
