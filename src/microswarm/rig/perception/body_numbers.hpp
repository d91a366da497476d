// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "microswarm/vision/tracking/assignment.hpp"
#include "microswarm/world/obstacles/body.hpp"

namespace microswarm {

/// Matches the bodies of consecutive pictures: `Body::obstacle` becomes the number of the nearest
/// body of the previous pictures, or a new one.
class BodyNumbers {
 public:
  /// `reach` [µm] is the maximum distance of a body from its predicted position.
  explicit BodyNumbers(double reach) : reach_(reach) {}

  /// Numbers the bodies of the next picture, taken at `t` [s].
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
