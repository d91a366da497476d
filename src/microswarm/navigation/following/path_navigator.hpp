// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "microswarm/core/maths/rng.hpp"
#include "microswarm/navigation/following/path_follower.hpp"
#include "microswarm/navigation/following/path_navigator_params.hpp"
#include "microswarm/navigation/steering/steering_navigator.hpp"

namespace microswarm::navigation {

/// Path-following navigator; see PathNavigatorParams. States: follow, fallback (pure pursuit
/// instead of the learned follower), hold, arrived, blind.
class PathNavigator : public SteeringNavigator {
 public:
  using Params = PathNavigatorParams;
  PathNavigator(const PathNavigatorParams& params, const Task& task, Rng);

  void prepare(const Snapshot& world, const Stop& stop) override;

 private:
  void update(const Observation& seen, const Stop& stop) override;
  Decision decide(const Moment& moment) override;
  Decision finish(const Decision& decision, const Observation& seen) override;
  bool path_is_clear(const Snapshot& world, Pose2 pose) const;

  PathNavigatorParams params_;
  PathFollower follower_;
  std::vector<Vec2> path_;  ///< including the goal
  PathPosition position_;
};

}  // namespace microswarm::navigation
