// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "microswarm/core/execution/stop.hpp"
#include "microswarm/world/map/map.hpp"

namespace microswarm::vision {

/// Point at which branches of a skeleton end or meet.
struct ChannelNode {
  Vec2 position{};   ///< [µm]
  double width = 0;  ///< [µm] diameter of the largest disc around it
  int degree = 0;    ///< number of branch ends: 1 for an end, 0 for a room without branches
  int network = 0;   ///< connected part of the skeleton, from 1
};

/// Kind of a branch, numbered as in skan and AnalyzeSkeleton.
enum class BranchType { end_end, junction_end, junction_junction, loop };

/// A branch of the skeleton. Widths are twice the clearance from walls and border on the middle
/// line, without the parts within the discs of its nodes, if anything is left.
struct ChannelBranch {
  int a = 0, b = 0;  ///< nodes, from 0; equal for a closed line
  int network = 0;
  BranchType type = BranchType::end_end;
  double length = 0;  ///< [µm] along the line, smoothed over a few cells
  double mean_width = 0, min_width = 0, max_width = 0;  ///< [µm]
  Vec2 narrowest{};                                     ///< [µm] where it is `min_width` wide
  std::vector<Vec2> line{};                             ///< [µm] from a to b
};

/// Skeleton of a map's free space as a graph.
struct ChannelGraph {
  std::vector<ChannelNode> nodes{};
  std::vector<ChannelBranch> branches{};
  double cell = 0;  ///< [µm] resolution
};

/// Finds the middle lines of the free space by thinning its cells of `cell` µm; 0 chooses a million
/// cells. Channels narrower than three cells may be cut. A branch that ends within 1.5 radii of the
/// disc around its junction is a corner of the channel, not a branch. `stop` ends it with an empty
/// graph. Throws InputError for a cell that gives too many cells.
ChannelGraph channel_graph(const Map& map, double cell = 0, const Stop& stop = {});

/// Tables with a header, units in the columns' names, branches and nodes numbered from 1.
std::string branch_table(const ChannelGraph& graph);
std::string node_table(const ChannelGraph& graph);

}  // namespace microswarm::vision
