// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "microswarm/report/plot.hpp"

namespace microswarm::reproduce {

/// Adds the outline of a violin around x: as wide as values are frequent, by a Gaussian kernel.
void add_violin(std::vector<double> values, double x, double half_width, Series& series);

}  // namespace microswarm::reproduce
