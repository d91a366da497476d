// SPDX-License-Identifier: Apache-2.0
#include "microswarm/navigation/gathering/policies/merged_robots.hpp"

#include <bit>
#include <cmath>
#include <numeric>

namespace microswarm::navigation {
namespace {

constexpr std::uint32_t nobody = ~0u;

/// Position or its grid cell, as one number.
std::uint64_t cell_key(float x, float y, double cell) {
  const auto part = [cell](float v) {
    return cell > 0 ? static_cast<std::uint32_t>(static_cast<std::int64_t>(std::floor(v / cell)))
                    : std::bit_cast<std::uint32_t>(v);
  };
  return std::uint64_t{part(x)} << 32 | part(y);
}

std::size_t mixed(std::uint64_t key) {
  key *= 0x9e3779b97f4a7c15u;
  return static_cast<std::size_t>(key ^ key >> 32);
}

}  // namespace

MergedRobots::MergedRobots(const Robots& robots)
    : positions_(robots), counts_(robots.size(), 1), place_of_(robots.size()) {
  std::iota(place_of_.begin(), place_of_.end(), 0u);
}

std::span<const std::uint32_t> MergedRobots::merge_coincident(double cell) {
  const std::size_t count = positions_.size();
  const std::size_t mask = std::bit_ceil(2 * count + 1) - 1;
  slots_.assign(mask + 1, nobody);
  merged_into_.resize(count);
  std::size_t kept = 0;
  // Kept positions move to the front, so a slot refers to an index below the current one.
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint64_t key = cell_key(positions_.x[i], positions_.y[i], cell);
    std::size_t slot = mixed(key) & mask;
    while (slots_[slot] != nobody &&
           cell_key(positions_.x[slots_[slot]], positions_.y[slots_[slot]], cell) != key)
      slot = (slot + 1) & mask;
    if (slots_[slot] == nobody) {
      slots_[slot] = static_cast<std::uint32_t>(kept);
      positions_.x[kept] = positions_.x[i];
      positions_.y[kept] = positions_.y[i];
      counts_[kept] = counts_[i];
      ++kept;
    } else {
      counts_[slots_[slot]] += counts_[i];
    }
    merged_into_[i] = slots_[slot];
  }
  if (kept == count) return {};
  positions_.x.resize(kept);
  positions_.y.resize(kept);
  counts_.resize(kept);
  for (std::uint32_t& position : place_of_) position = merged_into_[position];
  return merged_into_;
}

void MergedRobots::coarsen(std::size_t most, double cell) {
  constexpr int max_doublings = 16;
  for (int k = 0; k < max_doublings && positions_.size() > most; ++k, cell *= 2)
    merge_coincident(cell);
}

MergedRobots MergedRobots::condensed() const {
  MergedRobots all(positions_);
  all.counts_ = counts_;
  return all;
}

Robots MergedRobots::robots() const {
  Robots all{positions_.origin, {}, {}};
  for (const std::uint32_t position : place_of_) {
    all.x.push_back(positions_.x[position]);
    all.y.push_back(positions_.y[position]);
  }
  return all;
}

}  // namespace microswarm::navigation
