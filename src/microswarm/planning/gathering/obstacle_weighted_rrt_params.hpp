// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "microswarm/core/fields.hpp"

namespace microswarm {

/// The defaults are those of the published trees, where a channel is 10 wide; `scaled` fits them to
/// other channels.
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
    visit(self.nodes, {"nodes", Unit::none, {1, 1e7}, "Nodes of the tree."});
    visit(self.extension, {"extension", Unit::um, {1e-6, 1e6}, "Length of an edge of the tree."});
    visit(self.wall_samples, {"wall_samples",
                              Unit::none,
                              {0, 1},
                              "Share of the samples in walls that are used; less on sparse maps."});
    visit(self.weight_decay,
          {"weight_decay", Unit::none, {0, 1e6}, "a of the weight e^(b - a d), per um."});
    visit(self.weight_exponent,
          {"weight_exponent", Unit::none, {-50, 50}, "b of the weight e^(b - a d)."});
    visit(self.weight_cutoff,
          {"weight_cutoff", Unit::um, {0, 1e6}, "From this distance on the weight is 0."});
    visit(self.zeta, {"zeta", Unit::none, {0, 1e9}, "Nodes of less weight are near the middle."});
    visit(self.narrow_share, {"narrow_share",
                              Unit::none,
                              {0, 1},
                              "Near the middle of a channel too narrow for zeta; 0: as printed."});
    visit(self.neighbour_radius,
          {"neighbour_radius", Unit::um, {0, 1e6}, "Nodes nearer than this are adjacent."});
    visit(self.attach_radius,
          {"attach_radius", Unit::um, {0, 1e6}, "How far other nodes look for the middle."});
    visit(self.complete,
          {"complete", Unit::none, {}, "Add nodes where the tree has missed a branch."});
    visit(self.max_iterations, {"max_iterations", Unit::none, {1, 1e9}, "Samples at most."});
  }
};

/// The same parameters for a map `factor` times as large: same tree, same routes, `factor` times as
/// long. The published ones are for channels of 10 µm.
ObstacleWeightedRrtParams scaled(ObstacleWeightedRrtParams params, double factor);

}  // namespace microswarm
