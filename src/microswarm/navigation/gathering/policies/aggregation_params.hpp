// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string_view>
#include <utility>

#include "microswarm/core/fields/fields.hpp"
#include "microswarm/navigation/gathering/policies/rollout_params.hpp"
#include "microswarm/planning/gathering/map_segmentation_params.hpp"
#include "microswarm/planning/gathering/obstacle_weighted_rrt_params.hpp"

namespace microswarm::navigation {

/// Policy that chooses the leader of the robots.
enum class Aggregation {
  heuristic,              ///< the robot farthest from the goal: Alg 3 [gather], HRA
  divide_and_conquer,     ///< region after region, branch after branch: Alg 5 [gather], DCA
  rollout,                ///< a complete plan, improved by simulation of both: RolloutPolicy
  dynamic_shortest_path,  ///< the farther of the two farthest apart follows: DynamicShortestPath
};
constexpr auto enum_names(Aggregation) {
  return std::array<std::pair<Aggregation, std::string_view>, 4>{
      {{Aggregation::heuristic, "heuristic"},
       {Aggregation::divide_and_conquer, "divide_and_conquer"},
       {Aggregation::rollout, "rollout"},
       {Aggregation::dynamic_shortest_path, "dynamic_shortest_path"}}};
}

/// When the robots are gathered.
enum class Gathered {
  mean,  ///< F, the mean path length to the goal, is below σ [gather]
  all,   ///< every path length to the goal is below σ
};
constexpr auto enum_names(Gathered) {
  return std::array<std::pair<Gathered, std::string_view>, 2>{
      {{Gathered::mean, "mean"}, {Gathered::all, "all"}}};
}

/// Next region in Alg 5 [gather] when a team is no longer followed.
enum class DcaReading {
  rounds,     ///< ours: the farthest of this round; robots pushed back wait for the next round
  published,  ///< as in the authors' program: the farthest that contains robots
};
constexpr auto enum_names(DcaReading) {
  return std::array<std::pair<DcaReading, std::string_view>, 2>{
      {{DcaReading::rounds, "rounds"}, {DcaReading::published, "published"}}};
}

/// Parameters of an aggregation [gather]. Lengths are for channels 10 µm wide; `fitted` scales them
/// to a map's channels.
struct AggregationParams {
  static constexpr std::string_view type_name = "aggregation";
  Aggregation method = Aggregation::divide_and_conquer;
  DcaReading reading = DcaReading::rounds;
  int followed_regions = 3;
  int last_regions = 1;
  double team_depth = 10;
  bool obstacle_weighted = true;
  double scale = 1;
  double step = 1;
  double sigma = 10;
  Gathered gathered = Gathered::mean;
  double discount = 0.3;
  double discount_length = 5;
  int patience = 2;
  RolloutParams rollout{};
  planning::ObstacleWeightedRrtParams tree{};
  planning::MapSegmentationParams segmentation{};
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.method, plain("method", "Policy that chooses the moves."));
    visit(self.reading,
          plain("reading", "Next region of DCA: farthest of the round, or as published."));
    visit(self.followed_regions,
          plain("followed_regions", 0, 1000, "Number of regions into which DCA follows a team."));
    visit(self.last_regions,
          plain("last_regions", 1, 1000, "Regions near the goal that lead straight to it (DCA)."));
    visit(self.team_depth,
          um("team_depth", 0, 1e6, "Distance DCA leads a robot into the next region."));
    visit(self.obstacle_weighted,
          plain("obstacle_weighted", "Paths along the channel centre, not along the RRT."));
    visit(self.scale,
          plain("scale", 0, 1e6, "Factor of all lengths here; 0: channel width / 10 µm."));
    visit(self.step, um("step", 1e-6, 1e6, "Length of one move."));
    visit(self.sigma, um("sigma", 0, 1e6, "Distance to the goal below which they are gathered."));
    visit(self.gathered, plain("gathered", "Distance that must fall below sigma: mean or all."));
    visit(self.discount, plain("discount", 0, 1, "Discount of far robots, Eq 6."));
    visit(self.discount_length,
          um("discount_length", 1e-6, 1e6, "Path length over which the discount applies once."));
    visit(self.patience,
          plain("patience", 1, 1000, "Longest paths without progress before the livelock guard."));
    visit(self.rollout, plain("rollout", "Parameters of the rollout policy."));
    visit(self.tree, plain("tree", "Tree and its weights."));
    visit(self.segmentation,
          plain("segmentation", "Division of the map into regions and branches."));
  }
};

}  // namespace microswarm::navigation
