// SPDX-License-Identifier: Apache-2.0
#include "microswarm/core/status.hpp"

#include <cassert>

namespace microswarm {

std::string_view to_string(Status status) {
  switch (status) {
    case Status::solved:
      return "solved";
    case Status::no_path:
      return "no_path";
    case Status::node_limit:
      return "node_limit";
    case Status::time_limit:
      return "time_limit";
    case Status::stopped:
      return "stopped";
    case Status::start_blocked:
      return "start_blocked";
    case Status::goal_blocked:
      return "goal_blocked";
    case Status::held:
      return "held";
    case Status::collided:
      return "collided";
    case Status::fault:
      return "fault";
  }
  assert(false);
  return "unknown";
}

}  // namespace microswarm
