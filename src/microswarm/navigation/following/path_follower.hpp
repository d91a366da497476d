// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "microswarm/navigation/following/flow_estimate.hpp"
#include "microswarm/navigation/following/follower.hpp"
#include "microswarm/navigation/following/follower_model.hpp"
#include "microswarm/navigation/following/follower_params.hpp"

namespace microswarm {

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
  void update(const Observation& seen, const DelayCompensator& compensator);
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
