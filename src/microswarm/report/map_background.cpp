// SPDX-License-Identifier: Apache-2.0
#include "microswarm/report/map_background.hpp"

namespace microswarm {

std::string title_of(const Record& record) {
  const std::string& name = record.scene.scenario.name;
  return name.empty() ? "run" : name;
}

void draw_ground(Picture& picture, const Map& map, const ReportOptions& options) {
  if (!options.photo) return picture.walls(map);
  picture.photo(*options.photo, options.um_per_px, 0.25);
  picture.walls(map, {1, 1, 1, 0.55}, colours::wall_edge);
}

}  // namespace microswarm
