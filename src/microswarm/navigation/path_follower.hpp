// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <memory>
#include <string>
#include <utility>

#include "microswarm/core/fields.hpp"
#include "microswarm/navigation/flow_estimate.hpp"
#include "microswarm/navigation/follower.hpp"
#include "microswarm/navigation/follower_model.hpp"

namespace microswarm {

/// How a path is followed.
enum class FollowerKind {
  pure_pursuit,  ///< heads for a point of the path ahead
  learned        ///< a network taught by an expert [drrt]
};
constexpr auto enum_names(FollowerKind) {
  return std::array<std::pair<FollowerKind, std::string_view>, 2>{
      {{FollowerKind::pure_pursuit, "pure_pursuit"}, {FollowerKind::learned, "learned"}}};
}

/// Which follower a navigator has. The flow is told from what is seen; a model always knows it.
struct FollowerParams {
  FollowerKind kind = FollowerKind::pure_pursuit;
  bool correct_flow = false;
  std::string model;
  std::shared_ptr<const FollowerModel> loaded;  ///< what the file `model` holds
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.kind, {"kind", Unit::none, {}, "pure_pursuit, or learned."});
    visit(self.correct_flow, {"correct_flow",
                              Unit::none,
                              {},
                              "Pure pursuit steers against what is seen to carry the swarm off."});
    visit(self.model,
          {"model",
           Unit::none,
           {},
           "File of a learned follower, beside the scenario; the built-in one when left out."});
  }
};

/// Turns path and pose into a command. A learned follower hands over to pure pursuit where it was
/// not trained.
class PathFollower {
 public:
  struct Answer {
    Command command;
    bool handed_over = false;  ///< the learned follower did not know; this is pure pursuit
  };

  /// A model that is named must be loaded.
  PathFollower(const FollowerParams& params, const SwarmLimits& swarm);

  /// Takes in a frame with a swarm: first thing in a step.
  void see(const Observation& seen, const BodyForecast& forecast);
  /// The command for a swarm that will be at `pose` when it takes effect; moves `place` on.
  /// `lookahead` [µm] is that of pure pursuit. May be asked for poses to come. Allocates nothing.
  Answer command(std::span<const Vec2> path, PathPlace& place, const Pose2& pose, double lookahead,
                 double speed) const;
  /// What a learned follower is asked there; moves `place` on.
  FollowerQuery query(std::span<const Vec2> path, PathPlace& place, const Pose2& pose,
                      double speed) const;
  Vec2 flow() const { return flow_.flow(); }  ///< [µm/s]

 private:
  bool knows_flow() const { return learned_ || correct_flow_; }

  std::shared_ptr<const FollowerModel> loaded_;
  const FollowerModel* learned_ = nullptr;
  bool correct_flow_;
  double max_turn_rate_;
  double lag_;
  double delay_ = 0;  ///< from the frame to the effect [s]
  FlowEstimate flow_;
};

/// Pure pursuit that crabs: the heading at which a swarm of `speed` is carried towards the point
/// `lookahead` µm ahead by its own motion and the flow together.
Command pursue_in_flow(std::span<const Vec2> path, PathPlace& place, const Pose2& pose,
                       double lookahead, double speed, Vec2 flow);

}  // namespace microswarm
