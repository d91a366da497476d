// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "microswarm/geometry/shapes.hpp"
#include "microswarm/world/obstacles/motion.hpp"

namespace microswarm {

/// What a reader of maps hands on: everything a Map is built from, as it stood in the file.
struct MapParts {
  Box bounds;
  std::vector<Polygon> walls;
  std::vector<Disc> discs;
};

/// The smallest box around walls and discs.
Box box_of(const MapParts& parts);

/// Fingerprint of every bit: the same for the same map, whatever file it came from.
std::uint64_t fingerprint(const MapParts& parts);

/// Throws InputError "NAME: WHY" when the bounds are empty, or anything is not finite or beyond
/// max_coordinate.
void check(const MapParts& parts, const std::string& name);

}  // namespace microswarm
