// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "microswarm/vision/tracking/assignment.hpp"
#include "microswarm/world/obstacles/body.hpp"

namespace microswarm {

/// Knows the bodies of one picture again in the next: `Body::obstacle` gets the number of the body
/// that was nearest to there, or a new one.
class BodyNumbers {
 public:
  /// A body is not known again farther than `reach` [µm] from where it is expected.
  explicit BodyNumbers(double reach) : reach_(reach) {}

  /// The bodies of the next picture, taken at `t` [s].
  void number(std::vector<Body>& bodies, double t);

 private:
  struct Known {
    std::uint32_t number;
    Vec2 centre;
    Vec2 velocity;
    double t;
  };

  double reach_;
  std::uint32_t next_ = 0;
  std::vector<Known> known_;
  Assignment assignment_;
};

}  // namespace microswarm
