// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limits>
#include <span>
#include <vector>

#include "microswarm/core/fields/fields.hpp"
#include "microswarm/geometry/vec2.hpp"

namespace microswarm::experiment {

/// Minimum clearance of a run and its time.
struct LeastClearance {
  double clearance = std::numeric_limits<double>::infinity();  ///< from the swarm's centre [µm]
  double t = 0;                                                ///< [s]
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.clearance, um("clearance", "From the swarm's centre."));
    visit(self.t, s("t", "Time of the least clearance."));
  }
};

/// Obstacle-avoidance metrics of a run [radar]. Obstacles count while they are within the detection
/// range of the swarm's edge.
struct Avoidance {
  double mean_cost = 0;
  double time = 0;
  double mean_gap = 0;
  double min_gap = std::numeric_limits<double>::infinity();
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.mean_cost, plain("mean_cost", "Mean avoidance cost δ of the run, Eq 3, 4 [radar]."));
    visit(self.time, s("time", "Time with an obstacle in the detection circle."));
    visit(self.mean_gap,
          um("mean_gap", "Mean edge-to-edge gap to the nearest obstacle meanwhile."));
    visit(self.min_gap, um("least_gap", "Smallest gap; negative in a contact."));
  }
};

/// Avoidance cost δ, Eq 3, 4 [radar], while an obstacle is detected. `towards` [µm] is the
/// direction v_t without obstacles: to the goal, or to the phased goal being followed. `left` [µm]
/// is the distance to the goal, `start_distance` [µm] that from the start. A swarm at rest counts
/// as moving perpendicular to `towards`: it makes no progress.
double avoidance_cost(Vec2 towards, double left, double heading, bool moves, double start_distance);

/// Metrics of a run. They are physical and therefore equal in every repetition.
struct Metrics {
  double time = 0;
  double length = 0;
  double turning = 0;
  double goal_distance = 0;
  double hold_time = 0;
  LeastClearance walls{};
  LeastClearance obstacles{};
  Avoidance avoidance{};
  int planning_events = 0;
  int contacts = 0;
  int avoidable_contacts = 0;
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.time, s("time", "Simulated time at the end."));
    visit(self.length, um("length", "Length of the swarm's path."));
    visit(self.turning, deg("turning", "Total change of its heading."));
    visit(self.goal_distance,
          um("goal_distance", "Remaining distance; of robots the mean path or the worst."));
    visit(self.hold_time, s("hold_time", "Time spent in hold."));
    visit(self.walls, plain("walls", "Least clearance to walls and border."));
    visit(self.obstacles, plain("obstacles", "Least clearance to moving bodies."));
    visit(self.avoidance, plain("avoidance", "Avoidance of moving obstacles."));
    visit(self.planning_events, plain("planning_events", "Number of calls of a planner."));
    visit(self.contacts, plain("contacts", "Contacts with walls and moving bodies."));
    visit(self.avoidable_contacts,
          plain("avoidable_contacts", "Contacts while the swarm was driving."));
  }
};

/// Summary of wall-clock times [s]; all zero if there are none.
struct TimeSummary {
  int count = 0;
  double mean = 0;
  double sd = 0;
  double p50 = 0;
  double p99 = 0;
  double max = 0;
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.count, plain("count", "Number of values."));
    visit(self.mean, s("mean", "Mean."));
    visit(self.sd, s("sd", "Standard deviation (n − 1)."));
    visit(self.p50, s("p50", "Median."));
    visit(self.p99, s("p99", "99th percentile (nearest rank)."));
    visit(self.max, s("max", "Maximum."));
  }
};

/// Mean, standard deviation and percentiles of times [s].
TimeSummary summarise(std::span<const double> seconds);

/// Wall-clock times of a run [s]. They differ from run to run and are not part of its hash.
struct Timing {
  std::vector<double> steps{};     ///< of the navigator, one per frame
  std::vector<double> planning{};  ///< of steps with a planning event
};

}  // namespace microswarm::experiment
