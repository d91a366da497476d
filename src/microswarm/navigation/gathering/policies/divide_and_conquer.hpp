// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "microswarm/navigation/gathering/policies/aggregation_map.hpp"

namespace microswarm::navigation {

/// Choice of the leader in Alg 5 [gather]: region after region, branch after branch. Keeps its
/// state between decisions.
class DivideAndConquer {
 public:
  /// The map must outlive it.
  DivideAndConquer(const AggregationMap& map, const AggregationParams& params)
      : map_(&map), params_(params) {}

  /// Position that leads next; `last` led until now. There must be robots.
  std::size_t leader(const RobotsOnMap& robots, std::size_t last);

  /// Region and branch of the team that is led.
  std::uint32_t region() const { return region_; }
  std::uint32_t branch() const { return branch_; }

 private:
  std::uint32_t last_regions() const { return static_cast<std::uint32_t>(params_.last_regions); }
  bool is_led_on(const RobotsOnMap& robots, std::size_t robot);
  std::uint32_t next_region(const RobotsOnMap& robots) const;
  bool is_empty(const RobotsOnMap& robots, std::uint32_t region) const;
  std::uint32_t richest_branch(const RobotsOnMap& robots) const;
  std::size_t nearest_to_gate(const RobotsOnMap& robots) const;
  std::size_t farthest_in_region(const RobotsOnMap& robots) const;
  double distance_to_gate(const RobotsOnMap& robots, std::size_t robot) const;

  const AggregationMap* map_;
  AggregationParams params_;
  std::uint32_t region_ = 0;
  std::uint32_t branch_ = 0;
  std::uint32_t round_ = 0;  ///< farthest region still open in this round
  bool leads_ = false;
  double target_distance_ = 0;  ///< down to which the leader is led; infinity: out of its region
  std::uint32_t entered_ = 0;   ///< last region into which a robot was led
  int followed_ = 0;            ///< number of times the team was followed
};

}  // namespace microswarm::navigation
