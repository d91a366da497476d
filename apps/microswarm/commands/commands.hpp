// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "support/cli.hpp"
#include "support/command.hpp"

namespace microswarm::cli {

/// Each adds the command of its name with its options; parsing it sets `action`.
void add_run(Command app, Action& action);
void add_plan(Command app, Action& action);
void add_gather(Command app, Action& action);
void add_global(Command app, Action& action);
void add_replay(Command app, Action& action);
void add_report(Command app, Action& action);
void add_schema(Command app, Action& action);
void add_sweep(Command app, Action& action);
void add_export(Command app, Action& action);
void add_map(Command app, Action& action);
void add_track(Command app, Action& action);
void add_rig(Command app, Action& action);
void add_lab(Command app, Action& action);
void add_learn(Command app, Action& action);
void add_reproduce(Command app, Action& action);
void add_bench(Command app, Action& action);
/// Adds `describe --json`, which is not listed: the program as data, for its reference.
void add_describe(CommandLine& line, Action& action);

}  // namespace microswarm::cli
