// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <variant>

#include "microswarm/planning/global_input/global_rrt.hpp"
#include "microswarm/planning/global_input/global_search.hpp"
#include "microswarm/session/planner_choice.hpp"

namespace microswarm::cli {

/// Values that `--set` of the command `global` changes.
using GlobalChoice = PlannerChoice<std::variant<GlobalSearchParams, GlobalRrtParams>>;

}  // namespace microswarm::cli
