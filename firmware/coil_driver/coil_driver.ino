// SPDX-License-Identifier: Apache-2.0
// Opens in the Arduino IDE (board: Mega 2560); the program is in main.c, beside this file.
