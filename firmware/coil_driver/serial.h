// SPDX-License-Identifier: Apache-2.0
// The serial line to the host: 115200 baud, 8 bits, no parity, 1 stop bit.
#pragma once

#include <stdbool.h>
#include <stdint.h>

void serial_begin(void);

// False when there is none.
bool serial_get(uint8_t* byte);

// Never waits: without room for all of it, it is lost, and the host asks again.
void serial_send(const uint8_t* frame, uint8_t length);
