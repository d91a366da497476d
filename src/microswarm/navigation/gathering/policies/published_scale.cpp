// SPDX-License-Identifier: Apache-2.0
#include "microswarm/navigation/gathering/policies/published_scale.hpp"

#include "microswarm/world/connectivity/channel_width.hpp"

namespace microswarm::navigation {

double published_scale(const AggregationParams& params, const Map& map, Rng& rng) {
  return params.scale > 0 ? params.scale : channel_width(map, rng) / published_channel_width;
}

AggregationParams fitted(AggregationParams params, const Map& map, Rng& rng) {
  const double factor = published_scale(params, map, rng);
  params.tree = planning::scaled(params.tree, factor);
  for (double* length : {&params.step, &params.sigma, &params.discount_length, &params.team_depth})
    *length *= factor;
  params.scale = 1;
  return params;
}

}  // namespace microswarm::navigation
