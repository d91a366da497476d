// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <span>

#include "microswarm/contracts/plan.hpp"
#include "microswarm/report/picture.hpp"
#include "microswarm/report/run_report.hpp"

namespace microswarm::report {

/// Draws a whole run: the travelled path with the swarm at its end, the last positions of obstacles
/// and, faint, earlier ones; of individually tracked robots the last recorded positions. The
/// planning events of `numbered` are marked on the path, and the moment of the least gap is drawn
/// where a radar or kept diagnostics say how it was met. A run in progress shows the path that is
/// followed, a record without frames the start.
std::unique_ptr<Picture> draw_run(const experiment::Record& record,
                                  const ReportOptions& options = {},
                                  std::span<const experiment::PlanEvent* const> numbered = {});

/// Draws a map with its walls.
std::unique_ptr<Picture> draw_map(const Map& map, std::string_view title = {});

/// Draws a path in a map with its search tree, its start and its goal with the tolerance.
std::unique_ptr<Picture> draw_plan(const Map& map, const Plan& plan, Vec2 start, const Disc& goal,
                                   std::string_view title = {});

}  // namespace microswarm::report
