// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "microswarm/core/fields.hpp"

namespace microswarm {

/// The least clearance of a run and when it was.
struct LeastClearance {
  double clearance = std::numeric_limits<double>::infinity();  ///< from the swarm's centre [µm]
  double t = 0;                                                ///< [s]
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.clearance, {"clearance", Unit::um, {}, "From the swarm's centre."});
    visit(self.t, {"t", Unit::s, {}, "When."});
  }
};

/// What a run amounts to. Physical, hence the same in every repetition.
struct Metrics {
  double time = 0;
  double length = 0;
  double turning = 0;
  double goal_distance = 0;
  double hold_time = 0;
  LeastClearance walls;
  LeastClearance obstacles;
  int planning_events = 0;
  int contacts = 0;
  int avoidable_contacts = 0;
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.time, {"time", Unit::s, {}, "Simulated time at the end."});
    visit(self.length, {"length", Unit::um, {}, "Length of the swarm's way."});
    visit(self.turning, {"turning", Unit::deg, {}, "Total turning of its heading."});
    visit(self.goal_distance,
          {"goal_distance",
           Unit::um,
           {},
           "From the goal at the end: of the centre; of robots the mean way to it, or the worst "
           "robot's distance from its own."});
    visit(self.hold_time, {"hold_time", Unit::s, {}, "Time under the command to hold."});
    visit(self.walls, {"walls", Unit::none, {}, "Least clearance to walls and border."});
    visit(self.obstacles, {"obstacles", Unit::none, {}, "Least clearance to moving bodies."});
    visit(self.planning_events, {"planning_events", Unit::none, {}, "Times it called a planner."});
    visit(self.contacts, {"contacts", Unit::none, {}, "Touches of walls and moving bodies."});
    visit(self.avoidable_contacts,
          {"avoidable_contacts", Unit::none, {}, "Those while the swarm was driving."});
  }
};

/// Summary of a set of wall-clock times [s]; all zero for none.
struct TimeSummary {
  int count = 0;
  double mean = 0;
  double sd = 0;
  double p50 = 0;
  double p99 = 0;
  double max = 0;
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.count, {"count", Unit::none, {}, "How many."});
    visit(self.mean, {"mean", Unit::s, {}, "Mean."});
    visit(self.sd, {"sd", Unit::s, {}, "Standard deviation (n − 1)."});
    visit(self.p50, {"p50", Unit::s, {}, "Median."});
    visit(self.p99, {"p99", Unit::s, {}, "99th percentile (nearest rank)."});
    visit(self.max, {"max", Unit::s, {}, "Longest."});
  }
};

/// Mean, spread and percentiles of some times [s].
TimeSummary summarise(std::span<const double> seconds);

/// Wall-clock times of a run [s]: they differ from run to run and are no part of its hash.
struct Timing {
  std::vector<double> steps;     ///< navigator's step, one a frame
  std::vector<double> planning;  ///< steps in which it planned
};

}  // namespace microswarm
