// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

namespace microswarm {

/// The same as `median` of values that are all at least +0 and finite; faster for many of them, as
/// they are sorted into buckets by their leading bits first.
double median_of_magnitudes(std::span<const double> values);

}  // namespace microswarm
