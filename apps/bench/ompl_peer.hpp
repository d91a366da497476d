// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "microswarm/world/snapshot.hpp"

namespace microswarm::bench {

enum class OmplPlanner { rrt_connect, rrt_star, informed_rrt_star, bit_star, fmt_star };

std::string_view name_of(OmplPlanner planner);
std::string ompl_version();

/// What one OMPL planner did.
struct OmplResult {
  bool solved = false;
  double seconds = 0;  ///< of solve() alone
  double length = 0;   ///< of the path [µm]
  std::size_t vertices = 0;
};

/// What it is asked. States and motions are checked by our exact queries with the clearance, so
/// that both sides search the same space; the goal tolerance and the range are those of ours.
struct OmplQuery {
  const Snapshot& world;
  Vec2 start;
  Vec2 goal;
  double clearance = 40;
  double goal_tolerance = 50;
  double range = 80;
  unsigned samples = 1000;     ///< of FMT*
  double radius_factor = 1.1;  ///< of FMT*
  double free_area = 0;        ///< of FMT* [µm²]; 0: the bounds', as OMPL does by itself
  double max_seconds = 1;
  bool first_solution = true;  ///< stop at it, or use up the time
};

/// Runs a planner; `seed` is set once a process by OMPL, so only the first call's counts.
OmplResult run_ompl(OmplPlanner planner, const OmplQuery& query);

/// Motion checks a second of OMPL's DiscreteMotionValidator at its default resolution (1 % of the
/// space's extent), with our point check.
double ompl_motion_rate(const Snapshot& world, double clearance, const std::vector<Segment>& edges);

}  // namespace microswarm::bench
