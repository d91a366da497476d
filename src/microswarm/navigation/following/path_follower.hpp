// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "microswarm/navigation/following/flow_estimate.hpp"
#include "microswarm/navigation/following/follower.hpp"
#include "microswarm/navigation/following/follower_model.hpp"
#include "microswarm/navigation/following/follower_params.hpp"

namespace microswarm::navigation {

/// Computes the command that follows a path. A learned follower falls back to pure pursuit outside
/// its training range.
class PathFollower {
 public:
  struct Answer {
    Command command{};
    bool handed_over = false;  ///< pure pursuit, because the learned follower was not applicable
  };

  /// A model named in `params` must be loaded.
  PathFollower(const FollowerParams& params, const SwarmLimits& swarm);

  /// Processes a frame with a swarm; call it first in a step.
  void update(const Observation& seen, const DelayCompensator& compensator);
  /// Command for a swarm that is at `pose` when it takes effect; advances `position`. `lookahead`
  /// [µm] is that of pure pursuit. Future poses may be queried too. Does not allocate.
  Answer command(std::span<const Vec2> path, PathPosition& position, const Pose2& pose,
                 double lookahead, double speed) const;
  /// Inputs of a learned follower at that pose; advances `position`.
  FollowerQuery query(std::span<const Vec2> path, PathPosition& position, const Pose2& pose,
                      double speed) const;
  Vec2 flow() const { return flow_.flow(); }  ///< [µm/s]

 private:
  bool knows_flow() const { return learned_ || correct_flow_; }

  std::shared_ptr<const FollowerModel> loaded_;
  const FollowerModel* learned_ = nullptr;
  bool correct_flow_;
  double max_turn_rate_;
  double lag_;
  double delay_ = 0;  ///< from the frame until the command takes effect [s]
  FlowEstimate flow_;
};

/// Pure pursuit with drift correction: the heading at which a swarm of `speed`, moved by itself and
/// by the flow, reaches the point `lookahead` µm ahead.
Command pursue_in_flow(std::span<const Vec2> path, PathPosition& position, const Pose2& pose,
                       double lookahead, double speed, Vec2 flow);

}  // namespace microswarm::navigation
