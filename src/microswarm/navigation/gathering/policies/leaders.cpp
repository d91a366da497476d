// SPDX-License-Identifier: Apache-2.0
#include "microswarm/navigation/gathering/policies/leaders.hpp"

#include <algorithm>

namespace microswarm::navigation {
namespace {

bool is_on_its_way(const RobotsOnMap& robots, std::size_t robot, double step) {
  return robot < robots.lengths.size() && robots.lengths[robot] >= 2 * step;
}

}  // namespace

std::size_t farthest_robot(const RobotsOnMap& robots) {
  return static_cast<std::size_t>(std::ranges::max_element(robots.lengths) -
                                  robots.lengths.begin());
}

std::size_t heuristic_leader(const RobotsOnMap& robots, std::size_t last, double step) {
  return is_on_its_way(robots, last, step) ? last : farthest_robot(robots);
}

// The nearest robot whose path is longer than a random length.
std::size_t random_leader(const RobotsOnMap& robots, std::size_t last, double step, Rng& rng) {
  if (is_on_its_way(robots, last, step)) return last;
  std::size_t chosen = farthest_robot(robots);
  const double length = rng.uniform(0, robots.lengths[chosen]);
  for (std::size_t i = 0; i < robots.lengths.size(); ++i)
    if (robots.lengths[i] >= length && robots.lengths[i] < robots.lengths[chosen]) chosen = i;
  return chosen;
}

bool LivelockGuard::update(double mean_distance) {
  constexpr double min_progress = 0.01;
  if (mean_distance <= best_ - min_progress * sigma_) {
    best_ = mean_distance;
    since_best_ = 0;
  }
  if (!is_livelock_ && ++since_best_ > patience_) is_livelock_ = true;
  return is_livelock_;
}

}  // namespace microswarm::navigation
