// SPDX-License-Identifier: Apache-2.0
#include "support/program.hpp"

#include <malloc.h>  // glibc
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <new>
#include <string>
#include <string_view>

#include "microswarm/core/errors/error.hpp"

namespace microswarm::cli {
namespace {

using Clock = std::chrono::steady_clock;

std::atomic<bool> was_interrupted{false};
std::atomic<bool> is_reading{false};
std::atomic<Clock::rep> first_signal{0};
static_assert(std::atomic<bool>::is_always_lock_free &&
              std::atomic<Clock::rep>::is_always_lock_free);

// The first Ctrl-C requests a clean end, unless no work has begun; a second one ends at once.
// Programs such as `timeout` send the signal to the process and to its group, so a signal that
// follows immediately counts as the same one.
extern "C" void on_interrupt(int signal) {
  constexpr Clock::duration same = std::chrono::milliseconds(250);
  if (is_reading) ::_exit(not_reached);
  const Clock::rep now = Clock::now().time_since_epoch().count();
  if (!was_interrupted.exchange(true)) {
    first_signal = now;
  } else if (now - first_signal > same.count()) {
    std::signal(signal, SIG_DFL);
    std::raise(signal);
  }
}

/// Prefixes every line of an error message with the program's name.
int complain(const char* name, std::string_view what, int code) {
  for (bool more = true; more;) {
    const std::size_t end = what.find('\n');
    note("{}: {}\n", name, what.substr(0, end));
    more = end != std::string_view::npos;
    if (more) what.remove_prefix(end + 1);
  }
  return code;
}

/// Lets malloc keep freed memory, since pictures are allocated and freed repeatedly.
void keep_memory() {
#ifdef __GLIBC__
  mallopt(M_MMAP_THRESHOLD, 32 << 20);
  mallopt(M_TRIM_THRESHOLD, 256 << 20);
#endif
}

int act(const char* name, const Action& action) {
  try {
    const int code = action(Context(&was_interrupted));
    flush_output();
    if (code == complete) return ok;
    return code == ok && was_interrupted ? not_reached : code;
  } catch (const InputError& e) {
    return complain(name, e.what(), bad_input);
  } catch (const HardwareError& e) {
    return complain(name, e.what(), hardware);
  } catch (const std::filesystem::filesystem_error& e) {
    return complain(name, e.what(), bad_input);
  } catch (const std::bad_alloc&) {
    return complain(name, "out of memory", failed);
  } catch (const std::exception& e) {
    return complain(name, e.what(), failed);
  }
}

}  // namespace

Reading::Reading() { is_reading = true; }

Reading::~Reading() { is_reading = false; }

int run_program(const char* name, CommandLine& line, const Action& action, int argc, char** argv) {
  keep_memory();
  std::signal(SIGINT, on_interrupt);
  std::signal(SIGTERM, on_interrupt);
  std::signal(SIGQUIT, on_interrupt);
  std::signal(SIGHUP, on_interrupt);  // the terminal was closed
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);  // exceeding the file size limit is a write error
  try {
    if (const std::optional<int> code = line.parse(argc, argv)) return *code;
  } catch (const InputError& e) {
    return complain(name, e.what(), bad_input);
  }
  return act(name, action);
}

}  // namespace microswarm::cli
