// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "microswarm/report/plot.hpp"

namespace microswarm::reproduce {

/// Adds the outline of a violin at x, with widths from a Gaussian kernel density estimate.
void add_violin(std::vector<double> values, double x, double half_width, report::Series& series);

}  // namespace microswarm::reproduce
