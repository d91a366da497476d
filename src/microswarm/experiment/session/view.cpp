// SPDX-License-Identifier: Apache-2.0
#include "microswarm/experiment/session/view.hpp"

namespace microswarm::experiment {

SessionView session_view(const Tick& tick, std::uint64_t number, std::uint64_t plans) {
  SessionView view{.frame = tick.frame,
                   .number = number,
                   .end = tick.end,
                   .holding = tick.holding,
                   .plans = plans};
  const auto bodies = tick.world->moving().bodies();
  view.bodies.assign(bodies.begin(), bodies.end());
  if (tick.robots) view.robots.assign(tick.robots->begin(), tick.robots->end());
  view.path.assign(tick.view.path.begin(), tick.view.path.end());
  view.target = tick.view.local_target;
  if (const Plan* plan = tick.view.plan) {
    view.tree = plan->tree;
    view.detections = plan->detections;
  }
  view.events.assign(tick.events.begin(), tick.events.end());
  return view;
}

}  // namespace microswarm::experiment
