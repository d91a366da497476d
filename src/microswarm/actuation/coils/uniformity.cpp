// SPDX-License-Identifier: Apache-2.0
#include "microswarm/actuation/coils/uniformity.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "microswarm/core/errors/error.hpp"

namespace microswarm::actuation {
namespace {

std::pair<int, int> plane_axes(Plane plane) {
  if (plane == Plane::xy) return {0, 1};
  return plane == Plane::xz ? std::pair{0, 2} : std::pair{1, 2};
}

}  // namespace

Eigen::Vector3d UniformityMap::place(int column, int row) const {
  const auto [first, second] = plane_axes(grid.plane);
  const double step = 2 * grid.half_width / (grid.points - 1);
  Eigen::Vector3d p = grid.centre;
  p[first] += column * step - grid.half_width;
  p[second] += row * step - grid.half_width;
  return p;
}

double UniformityMap::largest() const {
  return *std::max_element(deviation.begin(), deviation.end());
}

double UniformityMap::radius_within(double share) const {
  std::vector<std::pair<double, bool>> positions;  // distance, exceeds `share`
  positions.reserve(deviation.size());
  for (int row = 0; row < grid.points; ++row)
    for (int column = 0; column < grid.points; ++column)
      positions.emplace_back((place(column, row) - grid.centre).norm(),
                             !(at(column, row) <= share));
  double broken = std::numeric_limits<double>::infinity();
  for (const auto& [far, deviates] : positions)
    if (deviates) broken = std::min(broken, far);
  double radius = 0;
  for (const auto& [far, deviates] : positions)
    if (far < broken) radius = std::max(radius, far);
  return std::min(radius, grid.half_width);
}

std::optional<UniformityMap> uniformity(const CoilSystem& system, const Eigen::VectorXd& currents,
                                        const UniformityGrid& grid,
                                        const std::function<bool(double share)>& go_on) {
  assert(grid.points >= 2 && grid.half_width > 0);
  UniformityMap map{.grid = grid, .centre_field = system.at(grid.centre).total_field(currents)};
  const double strength = map.centre_field.norm();
  if (!(strength > 0)) throw InputError("the field at the centre of the map is 0");
  for (int row = 0; row < grid.points; ++row) {
    for (int column = 0; column < grid.points; ++column) {
      map.field.push_back(system.at(map.place(column, row)).total_field(currents));
      map.deviation.push_back((map.field.back() - map.centre_field).norm() / strength);
    }
    if (go_on && !go_on((row + 1.0) / grid.points)) return std::nullopt;
  }
  return map;
}

bool in_workspace(const CoilSystem& system, const UniformityGrid& grid) {
  const UniformityMap map{.grid = grid, .centre_field = {}, .field = {}, .deviation = {}};
  const int last = grid.points - 1;
  return system.in_workspace(map.place(0, 0)) && system.in_workspace(map.place(last, 0)) &&
         system.in_workspace(map.place(0, last)) && system.in_workspace(map.place(last, last));
}

double fitting_half_width(const CoilSystem& system, UniformityGrid grid) {
  const double usual = grid.half_width;
  for (; grid.half_width > 1; grid.half_width *= 0.9)
    if (in_workspace(system, grid)) return grid.half_width;
  return usual;
}

}  // namespace microswarm::actuation
