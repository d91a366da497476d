// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "microswarm/experiment/record/record.hpp"
#include "microswarm/report/plot.hpp"

namespace microswarm {

/// The diagrams of a run of one body, where there is something to show: its planning times, its
/// clearance over time, and its avoidance cost over time.
std::vector<Plot> run_plots(const Record& record);

}  // namespace microswarm
