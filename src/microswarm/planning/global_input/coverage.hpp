// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "microswarm/planning/global_input/global_tree.hpp"

namespace microswarm::planning {

/// Fraction of the configuration space covered by a tree (Sec II-d [global]).
struct Coverage {
  std::size_t occupied = 0;    ///< hypercubes that contain at least one node
  std::size_t free_cells = 0;  ///< cells of the plane that a robot may occupy
  double share = 0;            ///< occupied, relative to free_cells ^ robots
};

/// Coverage by hypercubes of edge `cell` [µm], aligned with the low corner of the map's bounds.
/// Occupied ones are counted in a hash set, so memory grows with the nodes and not with the
/// hypercubes. A cell of the plane is free if a tree node has a robot in it, or a point of a 16 ×
/// 16 lattice in it is free (spacing a sixteenth of the cell). Throws InputError if the cell is not
/// above 0, or so small that the plane has more than 2^24 cells.
Coverage coverage(const Map& map, const GlobalTree& tree, double cell);

}  // namespace microswarm::planning
