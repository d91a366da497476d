// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace microswarm::cli {

/// The name by which an input file that was named on the command line can be opened:
/// - "-" is standard input. It and pipes of the shell, `<(COMMAND)`, are read to their end, so that
///   they can be opened like a file, more than once; Ctrl-C ends the program with exit code 3.
/// - A file that is not there may be a shipped one: "first_flight" or "scenarios/first_flight.yaml"
///   is first_flight.yaml of the program's scenarios, looked for in their folder `kind` ("rigs",
///   "maps", "sweeps", "queues") first; "samples/veins.csv" is one of the samples beside them. A
///   note says which file is used.
/// Throws InputError for what is larger than 1 GiB or cannot be read.
std::string find_input(const std::string& name, const std::string& kind = "");

}  // namespace microswarm::cli
