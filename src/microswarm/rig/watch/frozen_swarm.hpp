// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <vector>

#include "microswarm/formats/images/image.hpp"
#include "microswarm/vision/tracking/ring_fit.hpp"

namespace microswarm::rig {

/// Finds a picture that is frozen apart from its noise: where the swarm is, nothing changes by more
/// than noise and light change elsewhere, while the swarm is commanded to move.
class FrozenSwarm {
 public:
  /// `longest` [s] without a change; 0: not checked.
  explicit FrozenSwarm(double longest) : longest_(longest) {}

  /// Takes a grey picture of the time `t` [s], the discs around the swarm or around each robot
  /// [px], and the distance commanded since the picture before [px].
  void take(const formats::Image& picture, std::span<const vision::Ring> swarm, double commanded_px,
            double t);
  /// Why a run must end; empty if it need not.
  const std::string& fault() const { return fault_; }

 private:
  bool has_changed(const formats::Image& picture, std::span<const vision::Ring> swarm) const;

  double longest_;
  formats::Image before_;  // the last picture in which something changed
  double since_ = 0;       // its time [s]
  double commanded_ = 0;   // [px] since then
  int pictures_ = 0;       // since then
  std::string fault_;
};

}  // namespace microswarm::rig
