// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "microswarm/core/rng.hpp"
#include "microswarm/navigation/gathering/aggregation_policy.hpp"

namespace microswarm {

/// Usual width [µm] of a map's channels, estimated at random points: in a channel of width w the
/// mean clearance of a free point is w/4. Throws InputError when no free point is found.
double channel_width(const Map& map, Rng& rng);

/// Width of the channels [µm] that the published lengths are for.
inline constexpr double published_channel_width = 10;

/// The parameters' scale; measured on the map where it is 0.
double scale_of(const AggregationParams& params, const Map& map, Rng& rng);

/// The parameters with all lengths multiplied by their scale, which is 1 then.
AggregationParams fitted(AggregationParams params, const Map& map, Rng& rng);

}  // namespace microswarm
