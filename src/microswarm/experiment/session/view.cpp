// SPDX-License-Identifier: Apache-2.0
#include "microswarm/experiment/session/view.hpp"

#include "microswarm/navigation/gathering/aggregation_navigator.hpp"
#include "microswarm/navigation/radar/radar.hpp"
#include "microswarm/navigation/radar/radar_circles.hpp"

namespace microswarm {
namespace {

std::optional<RadarScan> radar_of(const Navigator* navigator, const Snapshot& world) {
  const auto* radar = dynamic_cast<const RadarNavigator*>(navigator);
  if (!radar || !radar->last_look()) return std::nullopt;
  return scan(*radar->last_look(), world, radar->directions());
}

}  // namespace

SessionView view_of(const Tick& tick, std::uint64_t number, std::uint64_t plans,
                    const Navigator* navigator) {
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
  view.radar = radar_of(navigator, *tick.world);
  return view;
}

std::optional<AggregationView> aggregation_of(const Navigator& navigator) {
  const auto* gathers = dynamic_cast<const AggregationNavigator*>(&navigator);
  if (!gathers || !gathers->map()) return std::nullopt;
  const AggregationMap& map = *gathers->map();
  return AggregationView{map.tree.nodes, map.routes().next, map.segmentation};
}

}  // namespace microswarm
