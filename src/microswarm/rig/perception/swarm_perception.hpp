// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "microswarm/formats/images/mask.hpp"
#include "microswarm/rig/perception/body_numbers.hpp"
#include "microswarm/rig/perception/perception.hpp"

namespace microswarm {

/// Detects one swarm among moving obstacles. Its heading is its last direction of motion.
class SwarmPerception : public Perception {
 public:
  /// The swarm starts at `start`.
  SwarmPerception(const PerceptionParams& params, const Map& map, const Pose2& start,
                  const CameraView& view);

  const Detections& process(const Image& picture, double t) override;

 private:
  void tell_heading(Vec2 place);

  PerceptionParams params_;
  CameraScale scale_;
  Mask walls_;
  BodyNumbers numbers_;
  Vec2 from_;  // position at the last update of the heading
  double heading_;
  std::optional<Vec2> before_px_;
  Detections detections_;
};

}  // namespace microswarm
