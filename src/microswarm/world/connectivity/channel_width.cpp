// SPDX-License-Identifier: Apache-2.0
#include "microswarm/world/connectivity/channel_width.hpp"

#include "microswarm/core/errors/error.hpp"
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

}  // namespace microswarm
