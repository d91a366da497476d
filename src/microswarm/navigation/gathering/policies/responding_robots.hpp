// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "microswarm/swarm/robots/robot_stepper.hpp"
#include "microswarm/world/map/map.hpp"

namespace microswarm::navigation {

/// The robots that respond to the input. A robot that leads, or is looked at, and hardly moves
/// where its way is free is set aside until it moves again: a particle that sticks, dust, a false
/// detection.
class RespondingRobots {
 public:
  static constexpr std::size_t nobody = ~std::size_t{0};

  /// `step` [µm] is the length of a move. The map must outlive it.
  RespondingRobots(const Map& map, double step) : map_(&map), step_(step) {}

  /// Takes all robots after a move; `counts`, where given, is the number of robots at each
  /// position. Returns whether others respond than before.
  bool update(const Robots& robots, std::span<const std::uint32_t> counts);
  /// Takes the next move [µm] and a robot by which it is to be judged, an index into `robots()`.
  void judge_by(std::size_t robot, Vec2 move);
  /// Takes the merging of positions: the new index of each old one.
  void remap(std::span<const std::uint32_t> new_positions);

  /// Those that respond, of the robots of the last update, which must still be there.
  const Robots& robots() const { return aside_.empty() ? *all_ : some_; }
  std::span<const std::uint32_t> counts() const {
    return aside_.empty() ? all_counts_ : std::span<const std::uint32_t>(some_counts_);
  }
  /// Index among all robots of one that responds; `nobody` stays so.
  std::size_t original(std::size_t robot) const {
    return aside_.empty() || robot >= index_.size() ? robot : index_[robot];
  }
  /// Indices of the robots that were set aside, ascending.
  std::span<const std::size_t> aside() const { return aside_; }

 private:
  struct Tally {
    float commanded = 0;  ///< moves that were free for it [µm]
    float followed = 0;   ///< its motion along them [µm]
  };
  struct Judged {
    std::size_t robot;
    Vec2 from, move;
  };
  void forget();
  bool judge(const Judged& judged);
  bool take_back();
  void select();

  const Map* map_;
  double step_;
  const Robots* all_ = nullptr;
  std::span<const std::uint32_t> all_counts_{};
  std::vector<Tally> tallies_;  ///< of each robot
  std::vector<Judged> judged_;
  std::vector<std::size_t> aside_;
  std::vector<Vec2> places_;  ///< where they were set aside
  Robots some_;
  std::vector<std::uint32_t> some_counts_;
  std::vector<std::size_t> index_;
};

}  // namespace microswarm::navigation
