// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "microswarm/planning/global_tree.hpp"
#include "reproduce.hpp"

namespace microswarm::cli {

/// Draws the plan in all forms of pictures; not at all without a folder to draw in.
void draw_plan(const ReproduceOptions& options, const std::string& name, const std::string& title,
               const Map& map, const GlobalPlan& plan, std::span<const Vec2> goals,
               double tolerance = 20);

/// Figures that show robots on maps: three in a vascular network (1) and in a digestive system (8),
/// four in Env 3 by a tree that is asked again (9, 10), two magnets (12); beyond: six robots.
std::vector<ReproduceRow> global_vascular(const ReproduceOptions& options, const Stop& stop);
std::vector<ReproduceRow> global_digestive(const ReproduceOptions& options, const Stop& stop);
std::vector<ReproduceRow> global_reuse(const ReproduceOptions& options, const Stop& stop);
std::vector<ReproduceRow> global_magnets(const ReproduceOptions& options, const Stop& stop);
std::vector<ReproduceRow> global_six(const ReproduceOptions& options, const Stop& stop);

}  // namespace microswarm::cli
