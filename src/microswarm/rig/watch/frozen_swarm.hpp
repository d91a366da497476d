// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <vector>

#include "microswarm/formats/images/image.hpp"
#include "microswarm/geometry/vec2.hpp"
#include "microswarm/vision/tracking/ring_fit.hpp"

namespace microswarm::rig {

/// Finds a picture that is frozen apart from its noise: where the swarm is, nothing changes by more
/// than noise and light change elsewhere, while the swarm is commanded to move.
class FrozenSwarm {
 public:
  /// `longest` [s] without a change after a command's `delay` [s]; 0: not checked.
  FrozenSwarm(double longest, double delay) : longest_(longest), delay_(delay) {}

  /// Takes a grey picture of the time `t` [s], the discs around the swarm or around each robot
  /// [px], and the displacement commanded since the picture before [px].
  void take(const formats::Image& picture, std::span<const vision::Ring> swarm, Vec2 commanded_px,
            double t);
  /// Why a run must end; empty if it need not.
  const std::string& fault() const { return fault_; }

 private:
  bool has_changed(const formats::Image& picture, std::span<const vision::Ring> swarm) const;

  double longest_, delay_;
  formats::Image before_;  // the last picture in which something changed
  Vec2 commanded_;         // displacement since then [px]
  double begun_ = 0;       // time of the picture before the first command since then [s]
  double last_ = 0;        // time of the picture before [s]
  int pictures_ = 0;       // since then
  std::string fault_;
};

}  // namespace microswarm::rig
