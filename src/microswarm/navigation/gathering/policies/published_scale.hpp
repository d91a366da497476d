// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "microswarm/core/maths/rng.hpp"
#include "microswarm/navigation/gathering/policies/aggregation_policy.hpp"

namespace microswarm::navigation {

/// Channel width for which the published lengths hold [µm].
inline constexpr double published_channel_width = 10;

/// Scale of the parameters; measured on the map if it is 0.
double published_scale(const AggregationParams& params, const Map& map, Rng& rng);

/// Parameters with all lengths multiplied by their scale, which is then set to 1.
AggregationParams fitted(AggregationParams params, const Map& map, Rng& rng);

}  // namespace microswarm::navigation
