// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "microswarm/core/execution/status.hpp"
#include "microswarm/core/execution/stop.hpp"
#include "microswarm/core/maths/infinity.hpp"
#include "microswarm/planning/space_time/space_time_grid.hpp"
#include "microswarm/planning/space_time/turn_first.hpp"

namespace microswarm::planning {

/// Point of a path in time. The next piece is driven straight at full speed, as late as the next
/// arrival permits; until then the swarm waits here.
struct TimedPoint {
  Vec2 position{};     ///< [µm]
  double arrival = 0;  ///< [s]
};

/// Any-angle safe-interval path planning (SIPP, Phillips and Likhachev 2011; any-angle, Yakovlev
/// and Andreychuk 2017). A state is a cell with one of its safe intervals, and its cost the
/// earliest known arrival there. A successor is reached from the state that is expanded or straight
/// from the parent of that state, with the earliest departure that permits it. Straight ways from a
/// parent are tested when they would be expanded next (as by Lazy Theta*), at most one a state. The
/// search ends at the goal, or at the horizon of the grid, after which only standing cells count,
/// on the way or waiting in a cell that is safe until then. Allocates only for larger searches than
/// before; reserve() prevents that.
class SafeIntervalSearch {
 public:
  using Cell = SpaceTimeGrid::Cell;

  struct Query {
    Vec2 from{};                       ///< [µm]
    double stay_until = 0;             ///< time for which the swarm may wait there [s]
    std::span<const Cell> entries{};   ///< cells to which it may move from there
    double speed = 1;                  ///< [µm/s]
    std::optional<double> heading{};   ///< course from which a turn costs [rad]
    double turn_cost = 0;              ///< of the first course's turn [s/rad]
    TurnFirst turning{};               ///< time for turns
    std::span<const float> lengths{};  ///< from each cell to the goal without moving bodies [µm]
    double arrived = 0;                ///< length from which on the goal is reached [µm]
    int max_expansions = std::numeric_limits<int>::max();
  };

  void reserve(const SpaceTimeGrid& grid, std::size_t states);
  /// Searches the path of earliest arrival: `solved`; `no_path` if none leads to the goal or the
  /// horizon; `node_limit`, `stopped` or `time_limit` with the path nearest to the goal so far.
  Status find(const SpaceTimeGrid& grid, const Query& query, const Stop& stop = {});
  /// Path of the last search from its start on; empty after `no_path`.
  std::span<const TimedPoint> path() const { return path_; }
  /// Whether the swarm waits at the end of the path until the horizon.
  bool ends_in_stay() const {
    return path_.size() > 1 && path_.back().position == path_[path_.size() - 2].position;
  }
  /// Time of arrival at the goal [s], beyond the end of the path without moving bodies.
  double arrival() const { return arrival_; }
  /// The same with the cost of turning [s].
  double cost() const { return cost_; }
  /// Number of states that the last search expanded.
  int expansions() const { return expansions_; }

 private:
  static constexpr std::uint32_t none = ~std::uint32_t{0};

  struct alignas(64) State {
    Vec2 position{};
    double time = 0;                  ///< earliest arrival [s]
    double turn_cost = 0;             ///< [s]
    double shortcut_time = infinity;  ///< bound of the arrival on the shortcut [s]
    std::uint32_t shortcut = none;    ///< state from which a straight way is to be tested
    std::uint32_t parent = none;
    std::uint32_t next = none;  ///< another safe interval of the cell
    int end = 0;                ///< slot at which the safe interval ends
    Cell cell = 0;
    bool closed = false;
  };
  /// States of a cell.
  struct Reached {
    std::uint32_t search = 0;    ///< number of the search that reached it last
    std::uint32_t first = none;  ///< state
  };
  /// A step of grid_steps in a search.
  struct Step {
    int column = 0;
    int row = 0;
    double duration = 0;  ///< [s]
    double half = 0;      ///< time from the cell's border to its centre [s]
  };
  enum class Next { expand, test_shortcut, stay_to_horizon };
  struct Open {
    double cost;
    std::uint32_t state;
    Next next;
    friend bool operator<(const Open& a, const Open& b) {
      // Without a branch, which would be mispredicted.
      return (a.cost > b.cost) | ((a.cost == b.cost) & (a.state > b.state));
    }
  };

  void begin(const SpaceTimeGrid& grid, const Query& query);
  void expand(const SpaceTimeGrid& grid, const Query& query, std::uint32_t state);
  /// A straight move to a cell.
  struct Move {
    double arrival = 0;    ///< earliest [s]
    double turn_cost = 0;  ///< of the path [s]
    double duration = 0;   ///< [s]
  };
  /// A cell and its centre.
  struct Place {
    Cell cell = 0;
    Vec2 position{};
  };
  void connect(const SpaceTimeGrid& grid, const Query& query, std::uint32_t from, const Place& to,
               bool is_shortcut);
  /// Bounds of a move.
  struct Bounds {
    int slot = 0;        ///< first one in which the cell may be entered
    double arrival = 0;  ///< lower bound of the arrival without a wait [s]
    double half = 0;     ///< lower bound of the time from the cell's border to its centre [s]
    double latest = 0;   ///< upper bound of the begin of safe intervals that can be reached [s]
  };
  Bounds step_bounds(const SpaceTimeGrid& grid, const Query& query, std::uint32_t from,
                     const Step& step) const;
  Bounds shortcut_bounds(const SpaceTimeGrid& grid, const Query& query, std::uint32_t from,
                         Vec2 to) const;
  bool is_useless(const SpaceTimeGrid& grid, std::uint32_t from, Cell to, const Bounds& bounds,
                  bool is_shortcut) const;
  double until(const SpaceTimeGrid& grid, const Query& query, std::uint32_t state) const;
  double cost_of_turn(const Query& query, Vec2 course) const;
  double turn_delay(const Query& query, const State& from, Vec2 course) const;
  void note_shortcut(const SpaceTimeGrid& grid, const Query& query, std::uint32_t from,
                     std::uint32_t to, const Move& move);
  void relax(const SpaceTimeGrid& grid, const Query& query, std::uint32_t from, std::uint32_t to,
             const Move& move);
  void test_shortcut(const SpaceTimeGrid& grid, const Query& query, std::uint32_t state);
  void push(const Query& query, std::uint32_t state, double cost, Next next);
  std::uint32_t state_of(const Place& place, int end);
  void finish(const Query& query, std::uint32_t last, double until = 0);

  std::vector<State> states_;     ///< the start is first
  std::vector<Open> open_;        ///< a heap
  std::vector<Reached> reached_;  ///< by cell
  std::array<Step, 16> steps_{};
  std::uint32_t number_ = 0;
  Vec2 ahead_{};  ///< direction of the query's heading
  std::vector<TimedPoint> path_;
  double arrival_ = 0;
  double cost_ = 0;
  int expansions_ = 0;
};

}  // namespace microswarm::planning
