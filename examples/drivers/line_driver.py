#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""A coil driver of one's own: put your amplifiers into apply(). docs/reference/line-protocol.md

    driver: {type: program, command: [python3, line_driver.py]}
"""
import select
import signal
import sys
import time


def serve(apply):
    """Obeys the host at stdin; `apply` gets a list of currents in A, one per channel."""
    host = open(0, "rb", buffering=0)  # a line in a buffer is not seen by select
    armed, fed, watchdog, zeros = False, 0.0, 0.0, []
    try:
        while True:
            left = fed + watchdog - time.monotonic()
            if armed and (left < 0 or not select.select([host], [], [], left)[0]):
                armed = False
                apply(zeros)
                print("nothing to obey in time: off", file=sys.stderr, flush=True)
            message = host.readline().split()
            if not message:
                break  # the host has gone
            word, number, values, answer = message[0], int(message[1]), zeros, "ok"
            if word == b"hello":
                zeros = values = [0.0] * int(message[4])
                watchdog = int(message[5]) / 1000
            if word == b"set" and not armed:
                answer = "off"
            elif word == b"set":
                values = [float(value) for value in message[2:]]
            else:
                armed = word == b"arm"
            apply(values)
            fed = time.monotonic() if word in (b"arm", b"set") else fed
            print(answer, number, *values, flush=True)
    finally:
        apply(zeros)
        print("the host has gone or an error came: off", file=sys.stderr, flush=True)


def apply(values):
    """Sends the currents to your amplifiers, here to none."""


if __name__ == "__main__":
    signal.signal(signal.SIGTERM, lambda *_: sys.exit())
    serve(apply)
