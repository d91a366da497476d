// SPDX-License-Identifier: Apache-2.0
#include <atomic>
#include <csignal>
#include <cstdio>
#include <exception>
#include <new>

#include "cli.hpp"
#include "microswarm/core/error.hpp"
#include "microswarm/core/version.hpp"

namespace {

std::atomic<bool> interrupted{false};
static_assert(std::atomic<bool>::is_always_lock_free);

// The first Ctrl-C asks for a clean end; a second one ends at once.
extern "C" void on_interrupt(int signal) {
  if (interrupted.exchange(true)) {
    std::signal(signal, SIG_DFL);
    std::raise(signal);
  }
}

int complain(const char* what, int code) {
  std::fprintf(stderr, "microswarm: %s\n", what);
  return code;
}

}  // namespace

int main(int argc, char** argv) {
  using namespace microswarm;
  std::signal(SIGINT, on_interrupt);
  std::signal(SIGTERM, on_interrupt);
  std::signal(SIGPIPE, SIG_IGN);

  CLI::App app{"Plans, steers, gathers and measures magnetic microrobot swarms.", "microswarm"};
  app.set_version_flag("--version", std::string(version));
  app.require_subcommand(1);
  app.failure_message([](const CLI::App*, const CLI::Error& e) {
    return std::string("microswarm: ") + e.what() + "\n";
  });
  cli::Action action;
  cli::add_run(app, action);
  cli::add_plan(app, action);
  cli::add_map(app, action);
  cli::add_replay(app, action);
  cli::add_report(app, action);
  cli::add_reproduce(app, action);
  cli::add_bench(app, action);
  cli::add_schema(app, action);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    return app.exit(e) == 0 ? cli::ok : cli::bad_input;
  }
  try {
    const int code = action({Stop(&interrupted)});
    if (std::fflush(stdout) != 0)
      return complain("cannot write the results to stdout", cli::failed);
    return code;
  } catch (const InputError& e) {
    return complain(e.what(), cli::bad_input);
  } catch (const std::bad_alloc&) {
    return complain("out of memory", cli::failed);
  } catch (const std::exception& e) {
    return complain(e.what(), cli::failed);
  }
}
