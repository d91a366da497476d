// SPDX-License-Identifier: Apache-2.0
#include "protocol.h"

#include <util/crc16.h>

uint16_t crc16(const uint8_t* bytes, uint8_t length) {
  uint16_t crc = 0xFFFF;
  while (length--) crc = _crc_xmodem_update(crc, *bytes++);
  return crc;
}

// Consistent overhead byte stuffing (Cheshire and Baker 1999): no 0 within a frame.
uint8_t decode_frame(uint8_t* bytes, uint8_t length) {
  uint8_t from = 0, to = 0;
  while (from < length) {
    const uint8_t code = bytes[from++];
    if (code == 0 || from + code - 1 > length) return 0;
    for (uint8_t k = 1; k < code; ++k) bytes[to++] = bytes[from++];
    if (from < length) bytes[to++] = 0;
  }
  return to;
}

uint8_t encode_frame(const uint8_t* packet, uint8_t length, uint8_t* frame) {
  uint8_t to = 1, mark = 0;
  for (uint8_t k = 0; k < length; ++k) {
    if (packet[k]) {
      frame[to++] = packet[k];
      continue;
    }
    frame[mark] = to - mark;
    mark = to++;
  }
  frame[mark] = to - mark;
  frame[to++] = 0;
  return to;
}
