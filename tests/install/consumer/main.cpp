// SPDX-License-Identifier: Apache-2.0
#include <iostream>

#include "microswarm/core/rng.hpp"
#include "microswarm/core/version.hpp"
#include "microswarm/geometry/vec2.hpp"

int main() {
  microswarm::Rng rng(1, microswarm::Purpose::test);
  const microswarm::Vec2 point{rng.uniform(), rng.uniform()};
  std::cout << "microswarm " << microswarm::version << ": " << norm(point) << " µm\n";
}
