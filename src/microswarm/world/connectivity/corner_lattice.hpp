// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "microswarm/world/map/map.hpp"

namespace microswarm {

/// Square lattice, parallel to the axes.
struct CornerLattice {
  Vec2 origin{};     ///< one of its points [µm]
  double pitch = 0;  ///< [µm]
};

/// The coarsest lattice on which the corners of a map's walls lie, as they do in maps made of cells
/// or pixels. It is derived from the corners only. Nothing if its pitch would be below
/// `min_pitch` [µm], which must be positive; corners count as on it within a thousandth of that,
/// and a hundredth of them may lie elsewhere. Discs do not count.
std::optional<CornerLattice> corner_lattice(const Map& map, double min_pitch);

/// The lattice that leads through the middle of the narrowest straight passage, between walls on
/// `corners`, that a swarm with this clearance [µm] fits. A wider passage is wider by a pitch, so
/// that it holds points of the lattice too.
CornerLattice through_narrowest_passage(const CornerLattice& corners, double clearance);

/// The fewest neighbours, along rows and columns, that are free with the clearance [µm] between two
/// places of the lattice that are not; at most `most`. If it is n, every n-th row and column still
/// leads through every straight passage.
int shortest_free_run(const Map& map, const CornerLattice& positions, double clearance, int most);

}  // namespace microswarm
