// SPDX-License-Identifier: Apache-2.0
#include "microswarm/report/map_background.hpp"

#include <algorithm>

namespace microswarm::report {

std::string default_title(const experiment::Record& record) {
  const std::string& name = record.scene.scenario.name;
  return name.empty() ? "run" : name;
}

const experiment::Frame& frame_at(const experiment::Record& record, double t) {
  const auto after =
      std::upper_bound(record.frames.begin(), record.frames.end(), t,
                       [](double time, const experiment::Frame& f) { return time < f.t; });
  return after == record.frames.begin() ? *after : *(after - 1);
}

void draw_ends(Picture& picture, const experiment::Scenario& scenario) {
  picture.mark(scenario.start->position, "start");
  picture.circle({*scenario.goal, scenario.goal_tolerance}, colours::goal, 2);
  picture.mark(*scenario.goal, "goal", colours::goal);
}

void draw_ground(Picture& picture, const Map& map, const ReportOptions& options) {
  if (!options.photo) return picture.walls(map);
  picture.photo(*options.photo, options.um_per_px, 0.25);
  picture.walls(map, {1, 1, 1, 0.55}, colours::wall_edge);
}

}  // namespace microswarm::report
