// SPDX-License-Identifier: Apache-2.0
#include "microswarm/navigation/gathering/policies/divide_and_conquer.hpp"

#include <algorithm>
#include <cmath>

#include "microswarm/core/maths/infinity.hpp"
#include "microswarm/core/maths/maths.hpp"

namespace microswarm::navigation {

std::size_t DivideAndConquer::leader(const RobotsOnMap& robots, std::size_t last) {
  if (leads_ && is_led_on(robots, last)) return last;
  bool follows = false;
  if (region_ == 0 || is_empty(robots, region_)) {  // lines 2, 3
    follows = region_ >= last_regions() && followed_ < params_.followed_regions &&
              !is_empty(robots, entered_);
    if (follows) {
      ++followed_;
      region_ = entered_;
      branch_ = map_->segmentation.branch[robots.nodes[last]];
    } else {
      followed_ = 0;
      region_ = round_ = next_region(robots);
    }
  }
  leads_ = true;
  target_distance_ = region_ < last_regions() ? 0 : infinity;
  if (region_ < last_regions()) return farthest_in_region(robots);
  if (!follows) branch_ = richest_branch(robots);  // line 4
  return nearest_to_gate(robots);                  // line 6
}

// Line 8: within its region and then some distance beyond, or to the goal.
bool DivideAndConquer::is_led_on(const RobotsOnMap& robots, std::size_t robot) {
  if (target_distance_ == infinity) {
    const std::uint32_t region = map_->segmentation.region[robots.nodes[robot]];
    if (region == region_) return true;
    entered_ = region;
    target_distance_ = std::max(0.0, robots.lengths[robot] - params_.team_depth);
  }
  return robots.lengths[robot] > target_distance_ + params_.step;
}

// The farthest region that holds robots. In rounds the map shrinks (Eq 7): robots that were pushed
// back behind the last one wait for the next round, which begins when only the goal's region is
// left.
std::uint32_t DivideAndConquer::next_region(const RobotsOnMap& robots) const {
  std::uint32_t in_round = 0;
  std::uint32_t of_all = 0;
  for (const std::uint32_t node : robots.nodes) {
    const std::uint32_t region = map_->segmentation.region[node];
    of_all = std::max(of_all, region);
    if (region <= round_) in_round = std::max(in_round, region);
  }
  return params_.reading == DcaReading::rounds && in_round > 0 ? in_round : of_all;
}

bool DivideAndConquer::is_empty(const RobotsOnMap& robots, std::uint32_t region) const {
  return std::none_of(robots.nodes.begin(), robots.nodes.end(), [&](std::uint32_t node) {
    return map_->segmentation.region[node] == region;
  });
}

std::size_t DivideAndConquer::nearest_to_gate(const RobotsOnMap& robots) const {
  const planning::MapSegmentation& map = map_->segmentation;
  std::size_t nearest = 0;
  double least = infinity;
  for (std::size_t i = 0; i < robots.nodes.size(); ++i) {
    const std::uint32_t node = robots.nodes[i];
    if (map.region[node] != region_ || map.branch[node] != branch_) continue;
    const double left = distance_to_gate(robots, i);
    if (left < least) {
      least = left;
      nearest = i;
    }
  }
  return nearest;
}

std::size_t DivideAndConquer::farthest_in_region(const RobotsOnMap& robots) const {
  std::size_t farthest = 0;
  double most = -1;
  for (std::size_t i = 0; i < robots.nodes.size(); ++i) {
    if (map_->segmentation.region[robots.nodes[i]] != region_ || robots.lengths[i] <= most)
      continue;
    most = robots.lengths[i];
    farthest = i;
  }
  return farthest;
}

// Eq 6 [gather]
std::uint32_t DivideAndConquer::richest_branch(const RobotsOnMap& robots) const {
  const planning::MapSegmentation& map = map_->segmentation;
  std::vector<double> value(std::max(1u, map.regions[region_].branches), -1);
  for (std::size_t i = 0; i < robots.nodes.size(); ++i) {
    if (map.region[robots.nodes[i]] != region_) continue;
    double& v = value[map.branch[robots.nodes[i]]];
    const double share =
        maths::pow(params_.discount, distance_to_gate(robots, i) / params_.discount_length);
    v = std::max(0.0, v) + robots.count(i) * on_lattice(share);
  }
  return static_cast<std::uint32_t>(std::max_element(value.begin(), value.end()) - value.begin());
}

double DivideAndConquer::distance_to_gate(const RobotsOnMap& robots, std::size_t robot) const {
  const planning::MapSegmentation& map = map_->segmentation;
  const Region& region = map.regions[map.region[robots.nodes[robot]]];
  return std::max(0.0, robots.lengths[robot] - map_->routes().length[region.node]);
}

}  // namespace microswarm::navigation
