// SPDX-License-Identifier: Apache-2.0
#include "microswarm/navigation/gathering/policies/channel_width.hpp"

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

double scale_of(const AggregationParams& params, const Map& map, Rng& rng) {
  return params.scale > 0 ? params.scale : channel_width(map, rng) / published_channel_width;
}

AggregationParams fitted(AggregationParams params, const Map& map, Rng& rng) {
  const double factor = scale_of(params, map, rng);
  params.tree = scaled(params.tree, factor);
  for (double* length : {&params.step, &params.sigma, &params.discount_length, &params.team_depth})
    *length *= factor;
  params.scale = 1;
  return params;
}

}  // namespace microswarm
