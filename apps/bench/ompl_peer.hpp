// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "microswarm/world/snapshot.hpp"

namespace microswarm::bench {

/// Planners of OMPL, their names, and OMPL's version.
enum class OmplPlanner { rrt_connect, rrt_star, informed_rrt_star, bit_star, fmt_star };
std::string_view to_text(OmplPlanner planner);
std::string ompl_version();

/// Result of an OMPL planner.
struct OmplResult {
  bool solved = false;
  double seconds = 0;  ///< of solve() alone
  double length = 0;   ///< of the path [µm]
  std::size_t vertices = 0;
};

/// A planning query. States and motions are checked by our exact queries with the clearance, so
/// both sides search the same space. Goal tolerance and range are the same as ours.
struct OmplQuery {
  const Snapshot& world;
  Vec2 start;
  Vec2 goal;
  double clearance = 40;
  double goal_tolerance = 50;
  double range = 80;
  unsigned samples = 1000;     ///< of FMT*
  double radius_factor = 1.1;  ///< of FMT*
  double free_area = 0;        ///< of FMT* [µm²]; 0: that of the bounds, OMPL's default
  double max_seconds = 1;
  bool first_solution = true;  ///< stop at the first solution instead of using all the time
};

/// Runs a planner. OMPL sets `seed` once per process, so only the first call's is used.
OmplResult run_ompl(OmplPlanner planner, const OmplQuery& query);

/// Motion checks per second of OMPL's DiscreteMotionValidator at its default resolution (1 % of the
/// space's extent), with our point check.
double ompl_motion_rate(const Snapshot& world, double clearance, const std::vector<Segment>& edges);

}  // namespace microswarm::bench
