// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>

#include "microswarm/navigation/gathering/policies/cell_graph.hpp"

namespace microswarm::navigation {

/// Two of a set of nodes, by their place in it, and their distance.
struct NodePair {
  std::size_t first = 0;
  std::size_t second = 0;
  std::uint32_t distance = 0;  ///< in units of the graph
};

/// The two of some nodes that are farthest apart by shortest path, exactly. There must be nodes;
/// those not connected with the first one are left out. In a network of channels a few searches
/// suffice: nodes are tried by decreasing distance from the middle between two that are far apart,
/// until twice that distance is no more than the farthest found.
NodePair farthest_pair(const CellGraph& graph, std::span<const std::uint32_t> nodes);

}  // namespace microswarm::navigation
