// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "microswarm/core/matching/assignment.hpp"
#include "microswarm/world/obstacles/body.hpp"

namespace microswarm::navigation {

/// Matches the bodies of consecutive pictures: `Body::obstacle` becomes the number of the nearest
/// body of the previous pictures, or a new one.
class BodyNumbers {
 public:
  /// `reach` [µm] is the maximum distance of a body from its predicted position; `first` is the
  /// first number.
  explicit BodyNumbers(double reach, std::uint32_t first = 0) : reach_(reach), next_(first) {}

  /// Numbers the bodies of the next picture, taken at `t` [s]. If stopped, some known bodies get
  /// new numbers.
  void number(std::vector<Body>& bodies, double t, const Stop& stop = {});
  /// Known bodies that were last seen as discs, at their expected positions at `t` [s].
  std::vector<Disc> expected_discs(double t) const;

 private:
  struct Known {
    std::uint32_t number;
    double radius;  // [µm] of a disc; 0 for another shape
    Vec2 centre;
    Vec2 velocity;
    double t;
    int pictures = 1;
  };

  double reach_;
  std::uint32_t next_;
  std::vector<Known> known_;
  Assignment assignment_;
};

}  // namespace microswarm::navigation
