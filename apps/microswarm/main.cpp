// SPDX-License-Identifier: Apache-2.0
#include "commands/commands.hpp"
#include "microswarm/core/version.hpp"
#include "microswarm/vision/image/messages.hpp"
#include "support/program.hpp"

namespace {

constexpr const char* footer =
    "microswarm COMMAND --help or microswarm help COMMAND describes a command. An input file may "
    "be\n"
    "- (standard input), or the name of a shipped scenario, rig, map or sweep: run first_flight.\n"
    "Exit codes: 0 success; 1 unexpected error; 2 bad input or command line, with a message in\n"
    "one line; 3 goal not reached, an aim missed, or interrupted by Ctrl-C with partial results;\n"
    "4 a device is missing or does not answer. A second Ctrl-C kills the program.";

}  // namespace

int main(int argc, char** argv) {
  using namespace microswarm;
  vision::silence_picture_messages();
  cli::CommandLine line("microswarm", "Plan, steer, gather and measure magnetic microrobot swarms.",
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
#ifdef MICROSWARM_HAS_LAB
  cli::add_lab(app, action);
#endif
#ifdef MICROSWARM_HAS_LEARNING
  cli::add_learn(app, action);
#endif
  cli::add_reproduce(app, action);
  cli::add_bench(app, action);
  cli::add_schema(app, action);
  cli::add_describe(line, action);
  return cli::run_program("microswarm", line, action, argc, argv);
}
