// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "support/cli.hpp"
#include "support/command.hpp"

namespace microswarm::cli {

/// The whole of a program: parses its command line, whose commands set `action`, runs that and
/// tells what goes wrong, "NAME: WHAT" a line. The first Ctrl-C asks for a clean end, a second one
/// ends at once. The exit code.
int run_program(const char* name, CommandLine& line, const Action& action, int argc, char** argv);

}  // namespace microswarm::cli
