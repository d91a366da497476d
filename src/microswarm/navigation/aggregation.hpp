// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "microswarm/core/fields.hpp"
#include "microswarm/navigation/crowd.hpp"
#include "microswarm/navigation/rollout_params.hpp"
#include "microswarm/planning/map_segmentation.hpp"
#include "microswarm/swarm/robot_stepper.hpp"

namespace microswarm {

/// Who leads the robots to the goal.
enum class Aggregation {
  heuristic,           ///< the robot farthest from the goal: Alg 3 [gather], HRA
  divide_and_conquer,  ///< region after region, branch after branch: Alg 5 [gather], DCA
  rollout,             ///< a plan to the end, made better in simulations of both: RolloutGatherer
};
constexpr auto enum_names(Aggregation) {
  return std::array<std::pair<Aggregation, std::string_view>, 3>{
      {{Aggregation::heuristic, "heuristic"},
       {Aggregation::divide_and_conquer, "divide_and_conquer"},
       {Aggregation::rollout, "rollout"}}};
}

/// Parameters of an aggregation [gather]. The lengths are for channels that are 10 µm wide;
/// `fitted` makes them as large as a map's channels.
struct AggregationParams {
  static constexpr std::string_view type_name = "aggregation";
  Aggregation method = Aggregation::divide_and_conquer;
  bool obstacle_weighted = true;
  double scale = 1;
  double step = 1;
  double sigma = 10;
  double discount = 0.3;
  double discount_length = 5;
  int patience = 4;
  double frame_timeout = 0.5;
  RolloutParams rollout;
  ObstacleWeightedRrtParams tree;
  MapSegmentationParams segmentation;
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.method,
          {"method", Unit::none, {}, "Who leads: heuristic, divide_and_conquer or rollout."});
    visit(self.obstacle_weighted,
          {"obstacle_weighted", Unit::none, {}, "Ways along the middle; false: along the RRT."});
    visit(self.scale, {"scale",
                       Unit::none,
                       {0, 1e6},
                       "Factor on all lengths here, which are for channels of 10 µm; 0: the usual "
                       "width of the map's channels / 10 µm."});
    visit(self.step, {"step", Unit::um, {1e-6, 1e6}, "Length of a move."});
    visit(self.sigma, {"sigma", Unit::um, {0, 1e6}, "Done when the mean way is shorter (F)."});
    visit(self.discount, {"discount", Unit::none, {0, 1}, "Discount of far robots in Eq 6."});
    visit(self.discount_length,
          {"discount_length", Unit::um, {1e-6, 1e6}, "Way over which it is applied once."});
    visit(self.patience, {"patience",
                          Unit::none,
                          {1, 1000},
                          "Longest ways without progress before the guard breaks a livelock."});
    visit(self.frame_timeout,
          {"frame_timeout", Unit::s, {0, 60}, "Hold when the newest frame is older than this."});
    visit(self.rollout, {"rollout", Unit::none, {}, "How a plan is made better."});
    visit(self.tree, {"tree", Unit::none, {}, "Tree and weights."});
    visit(self.segmentation, {"segmentation", Unit::none, {}, "Regions and branches."});
  }
};

/// What an aggregation knows of its map: the tree with its ways to the goal, and the regions. Made
/// once, shared by all that gather there.
struct AggregationMap {
  Map map;
  ObstacleWeightedRrt tree;
  MapSegmentation segmentation;

  /// Throws InputError when the goal is not free or the tree could not be grown.
  AggregationMap(Map map, Vec2 goal, const AggregationParams& params, Rng& rng);
};

/// Gathers robots at the goal with one input for all: Alg 3 and 5 [gather]. Both may be caught in a
/// livelock (robots that are handed to and fro). A guard watches the mean way to the goal: when it
/// has not become shorter for some of the map's longest ways, the farthest robot is driven all the
/// way, whatever the others do, and the guard waits twice as long the next time. After the third
/// time the farthest robot leads to the end (HRA). That this ends is not proven: `gather` has a
/// limit of steps.
class Gatherer {
 public:
  /// The map must outlive it. The method `rollout` is taken as divide_and_conquer.
  Gatherer(const AggregationMap& ground, const AggregationParams& params);

  /// The next move [µm] of all robots; nothing when they are gathered: F < σ. Where `counts` are
  /// given, so many robots are in each place. Looks only at those that moved since the last call.
  std::optional<Vec2> next(const Robots& robots, std::span<const std::uint32_t> counts = {});
  /// Tells that places were joined: the new place of each old one (see Crowd::join).
  void joined(std::span<const std::uint32_t> new_places);

  /// F(n, t): mean way to the goal [µm] of the robots last seen.
  double mean_way() const { return mean_way_; }
  /// The robot that leads.
  std::size_t leader() const { return leader_; }
  /// Where it is led to.
  Vec2 waypoint() const { return waypoint_; }
  /// How often the guard broke a livelock.
  int guard_count() const { return guard_count_; }

 private:
  void look(const Robots& robots, std::span<const std::uint32_t> counts);
  double count_of(std::size_t robot) const {
    return counts_.empty() ? 1 : static_cast<double>(counts_[robot]);
  }
  bool by_regions() const;
  std::size_t farthest() const;
  std::size_t heuristic() const;
  std::size_t divide_and_conquer();
  std::uint32_t next_region() const;
  std::uint32_t richest_branch(std::uint32_t region) const;
  double way_to_gate(std::size_t robot) const;
  double target_of(std::uint32_t region) const;
  bool arrived_in_next() const;
  bool guard();
  Vec2 waypoint_of(std::size_t robot, Vec2 p);

  const AggregationMap* ground_;
  AggregationParams params_;
  const Routes* routes_;
  double longest_ = 0;         ///< way [µm] from any node
  std::vector<float> seen_x_;  ///< where each robot was seen last
  std::vector<float> seen_y_;
  std::vector<std::uint32_t> counts_;       ///< robots in each place; empty: one
  std::vector<std::uint32_t> nodes_;        ///< nearest node of each robot
  std::vector<double> ways_;                ///< way to the goal of each robot [µm]
  std::vector<std::uint32_t> heading_for_;  ///< node that each robot was last led to
  double sum_ways_ = 0;                     ///< over all robots
  double robots_ = 0;                       ///< how many
  double mean_way_ = 0;
  std::size_t leader_ = ~std::size_t{0};
  Vec2 waypoint_;
  std::uint32_t region_ = 0;
  std::uint32_t branch_ = 0;
  bool leads_ = false;
  double target_way_ = 0;
  std::size_t last_leader_ = ~std::size_t{0};
  Vec2 last_place_;
  int held_ = 0;  ///< steps for which the leader has not moved
  double best_mean_ = 0;
  int since_best_ = 0;
  double patience_ = 0;
  std::optional<std::size_t> driven_;  ///< robot that the guard drives home
  int guard_count_ = 0;
};

/// How a gathering ended.
struct GatherResult {
  Status status = Status::time_limit;  ///< solved, time_limit (the steps ran out) or stopped
  int steps = 0;
  double mean_way = 0;  ///< F at the end [µm]
  int guard_count = 0;
};

/// Gathers robots in a simulation under the rule "stop"; they end where they were gathered.
GatherResult gather(const RobotStepper& stepper, Gatherer& gatherer, Robots& robots, int most_steps,
                    const Stop& stop = {});

}  // namespace microswarm
