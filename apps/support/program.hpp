// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "support/cli.hpp"
#include "support/command.hpp"

namespace microswarm::cli {

/// Runs a program: parses its command line, whose commands set `action`, calls the action, and
/// reports errors as lines "NAME: WHAT". The first Ctrl-C requests a clean end, a second one kills
/// the program. Returns the exit code.
int run_program(const char* name, CommandLine& line, const Action& action, int argc, char** argv);

}  // namespace microswarm::cli
