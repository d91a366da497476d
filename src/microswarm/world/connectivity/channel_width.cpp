// SPDX-License-Identifier: Apache-2.0
#include "microswarm/world/connectivity/channel_width.hpp"

#include <numbers>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/maths/angles.hpp"
#include "microswarm/geometry/uniform_in.hpp"

namespace microswarm {

double channel_width(const Map& map, Rng& rng) {
  constexpr int samples = 2000;
  const Box& box = map.bounds();
  double sum = 0;
  int count = 0;
  for (int i = 0; i < 1000 * samples && count < samples; ++i) {
    const double clearance = map.clearance(uniform_in(box, rng));
    if (clearance <= 0) continue;
    sum += clearance;
    ++count;
  }
  if (count == 0) throw InputError("no free space");
  return 4 * sum / count;
}

double width_around(const Map& map, Vec2 p) {
  constexpr int directions = 16, max_climbs = 1000;
  constexpr double least_share = 0.02;  // of the clearance, by which a climb must gain
  double clearance = map.clearance(p);
  for (int climb = 0; climb < max_climbs; ++climb) {
    const double before = clearance;
    const Vec2 from = p;
    for (int k = 0; k < directions; ++k) {
      const Vec2 q = from + 0.5 * before * unit_vector(2 * std::numbers::pi * k / directions);
      if (const double c = map.clearance(q); c > clearance) {
        clearance = c;
        p = q;
      }
    }
    if (clearance <= (1 + least_share) * before) break;
  }
  return 2 * clearance;
}

}  // namespace microswarm
