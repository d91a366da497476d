// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "microswarm/experiment/record/record.hpp"
#include "microswarm/report/plot.hpp"

namespace microswarm::report {

/// Diagrams of a run of one body, if there is data: planning times, clearance over time, and
/// avoidance cost over time.
std::vector<Plot> run_plots(const experiment::Record& record);

}  // namespace microswarm::report
