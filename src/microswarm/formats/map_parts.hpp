// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "microswarm/geometry/shapes.hpp"
#include "microswarm/world/obstacles/motion.hpp"

namespace microswarm::formats {

/// Output of map readers: everything that a Map is built from.
struct MapParts {
  Box bounds{};
  std::vector<Polygon> walls{};
  std::vector<Disc> discs{};
  std::vector<std::string> notes{};  ///< what was assumed or left out, one line each
};

/// Bounding box of walls and discs.
Box enclosing_box(const MapParts& parts);

/// "NAME: WHY" about walls and discs that are wholly outside the bounds, of which no map knows.
std::optional<std::string> outside_note(const MapParts& parts, const std::string& name);

/// Hash of every bit: equal for equal maps, independent of the file format.
std::uint64_t fingerprint(const MapParts& parts);

/// Throws InputError "NAME: WHY" if the bounds are empty, or anything is not finite or beyond
/// max_coordinate.
void check(const MapParts& parts, const std::string& name);

}  // namespace microswarm::formats
