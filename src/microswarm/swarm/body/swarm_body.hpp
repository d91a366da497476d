// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <variant>

#include "microswarm/swarm/body/ribbon.hpp"
#include "microswarm/swarm/body/swarm_limits.hpp"
#include "microswarm/swarm/body/swarm_params.hpp"
#include "microswarm/swarm/body/vortex.hpp"

namespace microswarm {

/// State of a swarm modelled as one body.
class SwarmBody {
 public:
  SwarmBody(const SwarmParams& params, Pose2 start);

  SwarmPose pose() const;
  double speed() const;  ///< [µm/s]
  /// See Ribbon::step and Vortex::step.
  void step(const Command& command, double dt, Rng& rng);
  std::span<const PoseStamped> trajectory() const;

 private:
  std::variant<Ribbon, Vortex> body_;
};

}  // namespace microswarm
