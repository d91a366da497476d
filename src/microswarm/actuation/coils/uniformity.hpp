// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "microswarm/actuation/coils/coil_system.hpp"

namespace microswarm::actuation {

/// A plane through two axes.
enum class Plane { xy, xz, yz };
constexpr auto enum_names(Plane) {
  return std::array<std::pair<Plane, std::string_view>, 3>{
      {{Plane::xy, "xy"}, {Plane::xz, "xz"}, {Plane::yz, "yz"}}};
}

/// Sampling square of a uniformity map: `points` × `points` positions around `centre`.
struct UniformityGrid {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();  ///< [µm]
  Plane plane = Plane::xy;
  double half_width = 10000;  ///< [µm]
  int points = 101;           ///< per side, at least 2
};

/// Deviation of the field from that at the centre. Row-major; the plane's first axis varies
/// fastest.
struct UniformityMap {
  UniformityGrid grid{};
  Eigen::Vector3d centre_field{};        ///< B0 [mT]
  std::vector<Eigen::Vector3d> field{};  ///< B [mT]
  std::vector<double> deviation{};       ///< |B − B0| / |B0|

  Eigen::Vector3d place(int column, int row) const;  ///< [µm]
  /// Relative deviation at a point of the grid.
  double at(int column, int row) const {
    return deviation[static_cast<std::size_t>(row) * grid.points + column];
  }
  /// Largest relative deviation.
  double largest() const;
  /// Distance from the centre of the farthest point inside which all points deviate by at most
  /// `share` [µm]; at most the half width.
  double radius_within(double share) const;
};

/// Computes the map for constant currents [A]. `go_on` is called after each row with the completed
/// share; if it returns false, the result is empty. Throws InputError if the field at the centre is
/// 0.
std::optional<UniformityMap> uniformity(const CoilSystem& system, const Eigen::VectorXd& currents,
                                        const UniformityGrid& grid,
                                        const std::function<bool(double share)>& go_on = {});

/// Whether the whole grid is inside the calibrated workspace.
bool in_workspace(const CoilSystem& system, const UniformityGrid& grid);

/// The grid's half width [µm], or less if the calibrated workspace is smaller.
double fitting_half_width(const CoilSystem& system, UniformityGrid grid);

}  // namespace microswarm::actuation
