// SPDX-License-Identifier: Apache-2.0
#include <malloc.h>  // of glibc

#include <atomic>
#include <csignal>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <new>
#include <string>
#include <string_view>

#include "cli.hpp"
#include "command.hpp"
#include "microswarm/core/error.hpp"
#include "microswarm/core/version.hpp"

namespace {

std::atomic<bool> was_interrupted{false};
static_assert(std::atomic<bool>::is_always_lock_free);

// The first Ctrl-C asks for a clean end; a second one ends at once.
extern "C" void on_interrupt(int signal) {
  if (was_interrupted.exchange(true)) {
    std::signal(signal, SIG_DFL);
    std::raise(signal);
  }
}

constexpr const char* footer =
    "microswarm COMMAND --help says more about a command.\n"
    "Exit codes: 0 done; 2 bad input or command line, told in one line; 3 ran, but the goal was "
    "not\n"
    "reached, a row falls short or Ctrl-C came once, which ends with what there is; a second\n"
    "Ctrl-C ends at once, by its signal;\n"
    "4 a device is not there or does not answer; 1 anything else.";

/// Every line of a complaint begins with the program's name.
int complain(std::string_view what, int code) {
  for (bool more = true; more;) {
    const std::size_t end = what.find('\n');
    std::fprintf(stderr, "microswarm: %s\n", std::string(what.substr(0, end)).c_str());
    more = end != std::string_view::npos;
    if (more) what.remove_prefix(end + 1);
  }
  return code;
}

/// Pictures come and go: their memory is kept, not given back to the system and cleared each time.
void keep_memory() {
#ifdef __GLIBC__
  mallopt(M_MMAP_THRESHOLD, 32 << 20);
  mallopt(M_TRIM_THRESHOLD, 256 << 20);
#endif
}

int act(const microswarm::cli::Action& action) {
  using namespace microswarm;
  try {
    const int code = action(cli::Context(&was_interrupted));
    cli::flush_output();
    return code;
  } catch (const InputError& e) {
    return complain(e.what(), cli::bad_input);
  } catch (const HardwareError& e) {
    return complain(e.what(), cli::hardware);
  } catch (const std::filesystem::filesystem_error& e) {
    return complain(e.what(), cli::bad_input);
  } catch (const std::bad_alloc&) {
    return complain("out of memory", cli::failed);
  } catch (const std::exception& e) {
    return complain(e.what(), cli::failed);
  }
}

}  // namespace

int main(int argc, char** argv) {
  using namespace microswarm;
  keep_memory();
  std::signal(SIGINT, on_interrupt);
  std::signal(SIGTERM, on_interrupt);
  std::signal(SIGQUIT, on_interrupt);
  std::signal(SIGHUP, on_interrupt);  // the terminal was closed
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);  // a file that may not grow is an error of writing

  cli::CommandLine line("microswarm",
                        "Plans, steers, gathers and measures magnetic microrobot swarms.",
                        std::string(version), footer);
  const cli::Command app = line.root();
  cli::Action action;
  cli::add_run(app, action);
  cli::add_plan(app, action);
  cli::add_global(app, action);
  cli::add_gather(app, action);
  cli::add_sweep(app, action);
  cli::add_export(app, action);
  cli::add_map(app, action);
  cli::add_track(app, action);
  cli::add_replay(app, action);
  cli::add_report(app, action);
  cli::add_rig(app, action);
#ifdef MICROSWARM_HAS_LEARNING
  cli::add_learn(app, action);
#endif
  cli::add_reproduce(app, action);
  cli::add_bench(app, action);
  cli::add_schema(app, action);
  try {
    if (const std::optional<int> code = line.parse(argc, argv)) return *code;
  } catch (const InputError& e) {
    return complain(e.what(), cli::bad_input);
  }
  return act(action);
}
