// SPDX-License-Identifier: Apache-2.0
// A computer that was suspended. Loaded before the C library (LD_PRELOAD), it adds the seconds in
// the file that FAKE_SUSPEND names to the clock that goes on while the computer is suspended.
#include <sys/syscall.h>
#include <time.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>

extern "C" int clock_gettime(clockid_t clock, timespec* t) {
  const long result = syscall(SYS_clock_gettime, clock, t);
  const char* const name = clock == CLOCK_BOOTTIME ? std::getenv("FAKE_SUSPEND") : nullptr;
  std::FILE* const file = name ? std::fopen(name, "r") : nullptr;
  if (!file) return static_cast<int>(result);
  int seconds = 0;
  if (std::fscanf(file, "%d", &seconds) == 1) t->tv_sec += seconds;
  std::fclose(file);
  return static_cast<int>(result);
}
