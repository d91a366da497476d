// SPDX-License-Identifier: Apache-2.0
#include "serial.h"

#include <avr/interrupt.h>
#include <avr/io.h>

#define ROOM 128  // a power of 2

typedef struct {
  volatile uint8_t bytes[ROOM];
  volatile uint8_t head, tail;
} Ring;

static Ring heard, said;

static uint8_t next(uint8_t at) { return (uint8_t)(at + 1) & (ROOM - 1); }

// When there is no room the byte is lost, and with it the frame, whose check sum fails.
ISR(USART0_RX_vect) {
  const uint8_t byte = UDR0;
  const uint8_t head = next(heard.head);
  if (head == heard.tail) return;
  heard.bytes[heard.head] = byte;
  heard.head = head;
}

ISR(USART0_UDRE_vect) {
  if (said.tail == said.head) {
    UCSR0B &= (uint8_t)~_BV(UDRIE0);
    return;
  }
  UDR0 = said.bytes[said.tail];
  said.tail = next(said.tail);
}

void serial_begin(void) {
  UBRR0 = 16;
  UCSR0A = _BV(U2X0);
  UCSR0C = _BV(UCSZ01) | _BV(UCSZ00);
  UCSR0B = _BV(RXEN0) | _BV(TXEN0) | _BV(RXCIE0);
}

bool serial_get(uint8_t* byte) {
  if (heard.head == heard.tail) return false;
  *byte = heard.bytes[heard.tail];
  heard.tail = next(heard.tail);
  return true;
}

void serial_send(const uint8_t* frame, uint8_t length) {
  uint8_t head = said.head;
  if (((uint8_t)(said.tail - head - 1) & (ROOM - 1)) < length) return;
  for (; length--; head = next(head)) said.bytes[head] = *frame++;
  said.head = head;
  cli();  // the interrupt clears this bit
  UCSR0B |= _BV(UDRIE0);
  sei();
}
