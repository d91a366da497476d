// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "microswarm/report/picture.hpp"
#include "microswarm/report/run_report.hpp"

namespace microswarm {

/// Title of a run in reports.
std::string default_title(const Record& record);

/// Frame at a time [s]: the last one that is not later, or the first.
const Frame& frame_at(const Record& record, double t);

/// Marks start and goal, with the goal's tolerance.
void draw_ends(Picture& picture, const Scenario& scenario);

/// Draws the walls, over the photograph if there is one.
void draw_ground(Picture& picture, const Map& map, const ReportOptions& options);

}  // namespace microswarm
