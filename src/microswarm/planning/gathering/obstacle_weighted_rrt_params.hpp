// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "microswarm/core/fields/fields.hpp"

namespace microswarm::planning {

/// Parameters of the tree. The defaults are those of the published trees, where a channel is 10
/// wide; `scaled` adapts them to other channels.
struct ObstacleWeightedRrtParams {
  static constexpr std::string_view type_name = "obstacle_weighted_rrt";
  int nodes = 4000;
  double extension = 1.2;
  double wall_samples = 1;
  double weight_decay = 1;
  double weight_exponent = 6;
  double weight_cutoff = 4;
  double zeta = 5;
  double narrow_share = 0.7;
  double neighbour_radius = 2.4;
  double attach_radius = 8;
  bool complete = true;
  int max_iterations = 10'000'000;
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.nodes, plain("nodes", 1, 1e7, "Number of tree nodes."));
    visit(self.extension, um("extension", 1e-6, 1e6, "Length of a tree edge."));
    visit(self.wall_samples,
          plain("wall_samples", 0, 1, "Share of samples in walls that are used."));
    visit(self.weight_decay,
          plain("weight_decay", 0, 1e6, "Decay a of the weight e^(b - a d), per µm."));
    visit(self.weight_exponent,
          plain("weight_exponent", -50, 50, "Exponent b of the weight e^(b - a d)."));
    visit(self.weight_cutoff, um("weight_cutoff", 0, 1e6, "Distance from which the weight is 0."));
    visit(self.zeta, plain("zeta", 0, 1e9, "Weight below which a node is near the middle."));
    visit(self.narrow_share,
          plain("narrow_share", 0, 1, "Share near the middle in narrow channels; 0: as printed."));
    visit(self.neighbour_radius,
          um("neighbour_radius", 0, 1e6, "Distance below which nodes are adjacent."));
    visit(self.attach_radius,
          um("attach_radius", 0, 1e6, "Search radius from other nodes to the middle."));
    visit(self.complete, plain("complete", "Add nodes where the tree missed a branch."));
    visit(self.max_iterations, plain("max_iterations", 1, 1e9, "Maximum number of samples."));
  }
};

/// The same parameters for a map scaled by `factor`: same tree and same routes, `factor` times as
/// long. The published ones are for channels of 10 µm.
ObstacleWeightedRrtParams scaled(ObstacleWeightedRrtParams params, double factor);

}  // namespace microswarm::planning
