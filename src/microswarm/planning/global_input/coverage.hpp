// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "microswarm/planning/global_input/global_tree.hpp"

namespace microswarm {

/// How much of the configuration space a tree has seen (Sec II-d [global]).
struct Coverage {
  std::size_t occupied = 0;    ///< hypercubes that hold at least one node
  std::size_t free_cells = 0;  ///< cells of the plane that a robot may be in
  double share = 0;            ///< of free_cells ^ robots
};

/// Hypercubes of edge `cell` [µm] from the low corner of the map's bounds on. Counts the occupied
/// ones in a hash set, so that memory goes with the nodes and not with the hypercubes. A cell of
/// the plane is free when a robot was seen in it, or a point of a lattice in it is free (16 × 16,
/// a sixteenth of the cell apart). Throws InputError when the cell is not above 0, or so small that
/// the plane has more than 2^24 cells.
Coverage coverage(const Map& map, const GlobalTree& tree, double cell);

}  // namespace microswarm
