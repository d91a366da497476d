// SPDX-License-Identifier: Apache-2.0
#include "serial.h"

#include <avr/interrupt.h>
#include <avr/io.h>

#define ROOM 128  // a power of 2

static volatile uint8_t bytes[ROOM];
static volatile uint8_t head, tail;

// When there is no room the byte is lost, and with it the frame, whose check sum fails.
ISR(USART0_RX_vect) {
  const uint8_t byte = UDR0;
  const uint8_t next = (uint8_t)(head + 1) & (ROOM - 1);
  if (next == tail) return;
  bytes[head] = byte;
  head = next;
}

void serial_begin(void) {
  UBRR0 = 16;
  UCSR0A = _BV(U2X0);
  UCSR0C = _BV(UCSZ01) | _BV(UCSZ00);
  UCSR0B = _BV(RXEN0) | _BV(TXEN0) | _BV(RXCIE0);
}

bool serial_get(uint8_t* byte) {
  if (head == tail) return false;
  *byte = bytes[tail];
  tail = (uint8_t)(tail + 1) & (ROOM - 1);
  return true;
}

void serial_put(uint8_t byte) {
  while (!(UCSR0A & _BV(UDRE0))) {
  }
  UDR0 = byte;
}
