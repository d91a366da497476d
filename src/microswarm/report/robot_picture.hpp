// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "microswarm/planning/global_input/global_tree.hpp"
#include "microswarm/world/map/map.hpp"

namespace microswarm::report {

/// Draws the robots' paths in a plan, each robot in its own colour with its start and, dashed, its
/// goal with the tolerance [µm]. The file's extension selects the format: .png, .svg or .pdf.
void draw_robots(const Map& map, const planning::GlobalPlan& plan, std::span<const Vec2> goals,
                 double tolerance, const std::string& title, const std::filesystem::path& file);

}  // namespace microswarm::report
