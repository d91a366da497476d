// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "microswarm/navigation/safe_interval/obstacle_forecast.hpp"
#include "microswarm/navigation/safe_interval/safe_interval_params.hpp"
#include "microswarm/planning/space_time/grid_distances.hpp"
#include "microswarm/planning/space_time/safe_interval_search.hpp"
#include "microswarm/planning/space_time/space_time_grid.hpp"

namespace microswarm::navigation {

/// Plans the earliest arrival on a grid over the whole map. Walls, bodies that rest and hollow
/// bodies stand in it; those that move occupy its slots. If standing bodies block every path, they
/// count within the horizon only. Where the grid is too coarse for the passages it is made finer.
/// Allocates when the grid is made.
class SpaceTimePlanner {
 public:
  /// Of the swarm, `radius` [µm] and `speed` [µm/s].
  SpaceTimePlanner(const SafeIntervalParams& params, double radius, double speed,
                   const planning::TurnFirst& turning);

  /// Makes the grid. `reached` is the region of the goal, whose centre has at least `clearance`
  /// [µm] from walls.
  void prepare(const Map& map, Disc reached, double clearance);
  /// Draws the bodies that stand again if they changed; `from` is the swarm's position, `now` the
  /// time [s].
  void refresh(const Map& map, const ObstacleForecast& forecast, Vec2 from, double now);
  /// Plans from `pose` with `share` of the gaps; `radius` [µm] is the swarm's, `clearance` [µm]
  /// what it needs from walls on the first move. See SafeIntervalSearch::find.
  Status plan(const Map& map, const ObstacleForecast& forecast, const Pose2& pose, double radius,
              double clearance, double share, const Stop& stop);

  std::span<const planning::TimedPoint> path() const { return search_.path(); }
  /// Whether the path ends at the goal, not at the horizon.
  bool ends_at_goal() const { return ends_at_goal_; }
  /// Whether the swarm waits at the end of the path until the horizon.
  bool ends_in_stay() const { return search_.ends_in_stay(); }
  /// Time left at the end of the path [s].
  double left() const { return left_; }
  /// Duration of the plan, with the cost of turning [s].
  double cost() const { return search_.cost(); }
  int expansions() const { return search_.expansions(); }
  /// Whether the cells are larger than wanted, so that the map takes no more than `max_cells`.
  bool is_coarse() const { return is_coarse_; }

 private:
  bool make_grid(const Map& map, int level);
  void let_walls_stand();
  void let_hollow_stand(const ObstacleForecast& forecast, double keep, int column, int row,
                        int columns, int rows);
  void find_entries(const Map& map, Vec2 from, double clearance);
  bool is_connected() const;
  bool changed(const ObstacleForecast& forecast, double now) const;

  SafeIntervalParams params_;
  double radius_;
  double speed_;
  planning::TurnFirst turning_;
  Disc reached_;
  double goal_clearance_ = 0;
  int level_ = 0;
  bool is_coarse_ = false;
  planning::SpaceTimeGrid grid_;
  planning::GridDistances distances_;
  planning::SafeIntervalSearch search_;
  std::vector<planning::GridDistances::Seed> seeds_;
  double arrived_ = 0;               ///< length from which on the goal is reached [µm]
  std::vector<std::uint8_t> walls_;  ///< by cell: 0 near a wall
  std::vector<planning::SpaceTimeGrid::Cell> entries_;
  std::vector<Disc> standing_;  ///< bodies drawn in the grid
  bool has_hollow_ = false;
  bool draws_standing_ = true;   ///< whether bodies that rest stand
  std::optional<double> drawn_;  ///< time of the last drawing [s]
  bool ends_at_goal_ = false;
  double left_ = 0;
};

}  // namespace microswarm::navigation
