// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "microswarm/report/picture.hpp"
#include "microswarm/report/run_report.hpp"

namespace microswarm::report {

/// Title of a run in reports.
std::string default_title(const experiment::Record& record);

/// Frame at a time [s]: the last one that is not later, or the first.
const experiment::Frame& frame_at(const experiment::Record& record, double t);

/// Marks start and goal, with the goal's tolerance.
void draw_ends(Picture& picture, const experiment::Scenario& scenario);

/// Draws the walls, over the photograph if there is one.
void draw_ground(Picture& picture, const Map& map, const ReportOptions& options);

}  // namespace microswarm::report
