// SPDX-License-Identifier: Apache-2.0
// The serial line to the host: 115200 baud, 8 bits, no parity, 1 stop bit.
#pragma once

#include <stdbool.h>
#include <stdint.h>

void serial_begin(void);

// False when there is none.
bool serial_get(uint8_t* byte);

// Waits for room; a byte is gone after 0.1 ms whatever the host does.
void serial_put(uint8_t byte);
