// SPDX-License-Identifier: Apache-2.0
#include "microswarm/report/robot_picture.hpp"

#include <fmt/format.h>

#include <vector>

#include "microswarm/report/picture.hpp"

namespace microswarm::report {

void draw_robots(const Map& map, const planning::GlobalPlan& plan, std::span<const Vec2> goals,
                 double tolerance, const std::string& title, const std::filesystem::path& file) {
  Picture picture(map.bounds(), title);
  picture.walls(map);
  for (std::size_t robot = 0; robot < goals.size(); ++robot) {
    const Colour colour = colours::robots[robot % colours::robots.size()];
    std::vector<Vec2> path;
    for (const auto& positions : plan.configurations) path.push_back(positions[robot]);
    picture.circle({goals[robot], tolerance}, colour, 2);
    picture.line(path, colour, 2.5);
    if (!path.empty()) {
      picture.mark(path.front(), fmt::format("start {}", robot + 1), colour);
      picture.mark(path.back(), "", colour);
    }
    picture.legend(fmt::format("robot {}{}", robot + 1, robot == 0 ? ", goals dashed" : ""),
                   colour);
  }
  picture.write(file);
}

}  // namespace microswarm::report
