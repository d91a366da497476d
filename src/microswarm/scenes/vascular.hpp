// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "microswarm/core/maths/rng.hpp"
#include "microswarm/geometry/shapes.hpp"
#include "microswarm/world/map/map.hpp"

namespace microswarm::scenes {

/// A network of channels as an obstacle map, with a goal in a dead end. One unit of [gather] is 1
/// µm.
struct Vascular {
  std::string name{};
  Box bounds{};
  std::vector<Polygon> walls{};
  Vec2 goal{};
  int nodes = 4000;   ///< of the tree, as published or with the same density
  double width = 10;  ///< typical channel width [µm]

  Map map() const { return Map(bounds, walls); }
};

/// The maps of Fig 8 [gather], with the coordinates of the authors' program. (a) is a bar with a
/// stem below it, 4,000 nodes and 2 regions; (b) is 100 × 100, 10,000 nodes and 9 regions; (c) is
/// 400 × 314, 40,000 nodes and 31 regions.
Vascular t_junction();
Vascular vascular_network();
Vascular larger_vascular_network();
/// A generated map similar in kind and size to Fig 8(c).
Vascular generated_vascular_network();

/// Channels as a graph: straight channels between joints, with the widths of their two ends.
struct ChannelGraph {
  Box bounds{};
  std::vector<Disc> joints{};  ///< the radius is half the width
  std::vector<std::pair<std::uint32_t, std::uint32_t>> channels{};
};
/// The walls: everything outside the channels.
std::vector<Polygon> graph_walls(const ChannelGraph& graph);

/// Settings of a generated map.
struct VascularShape {
  double width = 100;     ///< of the map [µm]
  double height = 90;     ///< of the map [µm]
  double spacing = 22;    ///< approximate distance between joints [µm]
  double min_half = 3.5;  ///< half the width of a channel [µm]
  double max_half = 5;
  double wander = 0.25;   ///< random offset of joints, in spacings
  double loops = 0.25;    ///< fraction of the channels beyond a tree that are kept
  double missing = 0.15;  ///< fraction of the grid positions without a joint
};

/// Random channels as a graph; joint 0 is a dead end. See random_vascular.
ChannelGraph random_channels(const VascularShape& shape, Rng& rng);
/// Random channels: a tree over joints offset from a grid, and some loops. Connected by
/// construction. The goal is at a dead end, which always exists.
Vascular random_vascular(const VascularShape& shape, Rng& rng);

}  // namespace microswarm::scenes
