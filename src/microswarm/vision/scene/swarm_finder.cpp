// SPDX-License-Identifier: Apache-2.0
#include "microswarm/vision/scene/swarm_finder.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace microswarm::vision {

SwarmSighting find_swarm(const formats::Image& picture, const SwarmFinderParams& params,
                         std::optional<Vec2> before_px, const formats::Mask* walls) {
  return choose_swarm(find_blobs(picture, params.look, walls), params, before_px);
}

SwarmSighting choose_swarm(std::vector<Blob> blobs, const SwarmFinderParams& params,
                           std::optional<Vec2> before_px) {
  SwarmSighting seen{.candidates = std::move(blobs)};
  std::vector<Blob>& all = seen.candidates;
  if (all.empty()) return seen;
  const auto keep = [&](auto&& is_candidate) {
    const auto from = std::stable_partition(all.begin(), all.end(), is_candidate);
    seen.others.insert(seen.others.end(), from, all.end());
    all.erase(from, all.end());
  };
  if (before_px)
    keep([&](const Blob& b) { return distance(b.centre_px, *before_px) <= params.jump; });
  if (all.empty()) {
    seen.sight = SwarmSight::far;
    return seen;
  }
  const double least = std::sqrt(params.rival) * all[0].radius_px;
  keep([&](const Blob& b) { return b.radius_px >= least; });
  if (all.size() == 1) {
    seen.sight = SwarmSight::found;
    seen.swarm = all[0];
  } else {
    seen.sight = SwarmSight::several;
  }
  return seen;
}

}  // namespace microswarm::vision
