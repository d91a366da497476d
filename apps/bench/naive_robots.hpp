// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "microswarm/world/map/map.hpp"

namespace microswarm::bench {

/// Straightforward stepping as reference: one robot after the other in double precision, each
/// against every edge of the map, stopping slightly before the nearest.
class NaiveRobots {
 public:
  NaiveRobots(const Map& map, std::vector<Vec2> positions);
  void step(Vec2 move);
  const std::vector<Vec2>& positions() const { return places_; }

 private:
  std::vector<Segment> edges_;
  std::vector<Vec2> places_;
};

}  // namespace microswarm::bench
