// SPDX-License-Identifier: Apache-2.0
#include "microswarm/navigation/gathering/policies/swarm_distances.hpp"

#include <algorithm>
#include <limits>
#include <numeric>

namespace microswarm::navigation {

void SwarmDistances::update(const Robots& robots, std::span<const std::uint32_t> counts) {
  const std::size_t n = robots.size();
  robots_.counts.assign(counts.begin(), counts.end());
  if (x_.size() != n) {
    sum_ = 0;
    x_.assign(n, std::numeric_limits<float>::quiet_NaN());
    y_.resize(n);
    robots_.nodes.resize(n);
    robots_.lengths.assign(n, 0);
    count_ = counts.empty() ? static_cast<double>(n)
                            : std::accumulate(counts.begin(), counts.end(), 0.0);
  }
  for (std::size_t i = 0; i < n; ++i) {
    if (robots.x[i] == x_[i] && robots.y[i] == y_[i]) continue;
    x_[i] = robots.x[i];
    y_[i] = robots.y[i];
    const Vec2 p = robots.position(i);
    const std::uint32_t node = robots_.nodes[i] = map_->tree.nearest(p);
    const double before = robots_.lengths[i];
    robots_.lengths[i] = on_lattice(map_->length_from(p, node));
    sum_ += robots_.count(i) * (robots_.lengths[i] - before);
  }
  mean_ = n > 0 ? sum_ / count_ : 0;
}

double SwarmDistances::left(Gathered measure) const {
  if (measure == Gathered::mean) return mean_;
  return robots_.lengths.empty() ? 0 : *std::ranges::max_element(robots_.lengths);
}

bool SwarmDistances::remap(std::span<const std::uint32_t> new_positions) {
  if (new_positions.size() != x_.size()) return false;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < new_positions.size(); ++i) {
    const std::size_t to = new_positions[i];
    if (to != kept) {
      sum_ += robots_.count(i) * (robots_.lengths[to] - robots_.lengths[i]);
      continue;
    }
    x_[kept] = x_[i];
    y_[kept] = y_[i];
    robots_.nodes[kept] = robots_.nodes[i];
    robots_.lengths[kept] = robots_.lengths[i];
    ++kept;
  }
  x_.resize(kept);
  y_.resize(kept);
  robots_.nodes.resize(kept);
  robots_.lengths.resize(kept);
  return true;
}

}  // namespace microswarm::navigation
