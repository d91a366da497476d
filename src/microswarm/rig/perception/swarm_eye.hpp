// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "microswarm/formats/images/mask.hpp"
#include "microswarm/rig/perception/body_numbers.hpp"
#include "microswarm/rig/perception/eye.hpp"

namespace microswarm {

/// Sees one swarm among moving obstacles. Its heading is the direction in which it last went.
class SwarmEye : public Eye {
 public:
  /// The swarm begins at `start`.
  SwarmEye(const EyeParams& params, const Map& map, const Pose2& start, const CameraView& view);

  const Sight& see(const Image& picture, double t) override;

 private:
  void tell_heading(Vec2 place);

  EyeParams params_;
  CameraScale scale_;
  Mask walls_;
  BodyNumbers numbers_;
  Vec2 from_;  // where the swarm was when its heading was told last
  double heading_;
  std::optional<Vec2> before_px_;
  Sight sight_;
};

}  // namespace microswarm
