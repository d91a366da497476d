// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <ostream>
#include <string>
#include <vector>

#include "microswarm/navigation/params.hpp"

namespace microswarm {

/// A navigator of a swarm seen as one body, as the laws take it.
struct BodyNavigator {
  std::string name;
  navigation::NavigatorParams params;
  std::uint64_t golden = 0;  ///< hash of its commands and states in fixed scenes
  bool allocates = false;    ///< its steps call a planner
  /// Contacts with a delay, in those worlds where it has none without; 1: it compensates no delay.
  double late_contacts = 0.06;
};

inline void PrintTo(const BodyNavigator& n, std::ostream* os) { *os << n.name; }

/// Every one there is; a new one joins all laws by a line here.
inline std::vector<BodyNavigator> body_navigators() {
  navigation::HierarchicalParams hierarchical;
  hierarchical.clearance = 40;
  navigation::HierarchicalParams hierarchical_learned = hierarchical;
  hierarchical_learned.follower.kind = navigation::FollowerKind::learned;
  navigation::PathNavigatorParams learned;
  learned.follower.kind = navigation::FollowerKind::learned;
  navigation::PathNavigatorParams against_flow;
  against_flow.follower.correct_flow = true;
  navigation::RadarParams radar;
  radar.target_gain = 0.01;
  navigation::RadarParams guided = radar;
  guided.waypoints = {{600, 400}};
  guided.safety_radius.adaptive = true;
  guided.obstacle_speed_bound = 50;
  navigation::RadarParams published = radar;
  published.as_published = true;
  return {{"Hierarchical", hierarchical, 0x633f1bd2f1a88fe4, true},
          {"HierarchicalLearned", hierarchical_learned, 0x92b57391d436c468, true},
          {"Path", navigation::PathNavigatorParams{}, 0x4ce7911165a783d9},
          {"PathAgainstFlow", against_flow, 0x2cdf8fd66303967f},
          {"PathLearned", learned, 0x891a8f1cfb0b1f27},
          {"Radar", radar, 0x45a98a87a1c1daea},
          {"RadarGuided", guided, 0xfc29d20f5f3f1faf},
          {"RadarAsPublished", published, 0x8fd591409b1c5021, false, 1},
          {"StraightStop", navigation::StraightParams{}, 0xdb787b10f3972ee0},
          {"PotentialField", navigation::PotentialFieldParams{}, 0xb25c0dc003a24249},
          {"VelocityObstacle", navigation::VelocityObstacleParams{}, 0x3cdda3d52bc4c9f6},
          {"SafeInterval", navigation::SafeIntervalParams{}, 0xfb1c6e0386a9195e}};
}

}  // namespace microswarm
