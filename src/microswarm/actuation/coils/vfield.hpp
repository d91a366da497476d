// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "microswarm/actuation/field/field.hpp"

namespace microswarm::actuation {

/// Field of one coil for one ampere, sampled on a regular grid and interpolated trilinearly.
class FieldGrid {
 public:
  /// `values` [mT/A] node by node, z fastest, x slowest; at least two nodes per direction.
  FieldGrid(const Eigen::Vector3d& lo, const Eigen::Vector3d& hi, std::array<int, 3> nodes,
            std::vector<Eigen::Vector3d> values);

  const Eigen::Vector3d& lo() const { return lo_; }  ///< [µm]
  const Eigen::Vector3d& hi() const { return hi_; }  ///< [µm]
  bool contains(const Eigen::Vector3d& position) const;
  /// Field and gradient at a position inside the grid. The gradient is that of the interpolant, so
  /// it is only approximately symmetric.
  FieldGradient at(const Eigen::Vector3d& position) const;

 private:
  const Eigen::Vector3d& node(int i, int j, int k) const;

  Eigen::Vector3d lo_, hi_;
  std::array<int, 3> nodes_;
  Eigen::Vector3d step_;
  std::vector<Eigen::Vector3d> values_;
};

/// Reads a grid of measured or computed fields for one ampere. Text format: the number of nodes;
/// the nodes in x, y, z; three lines "MIN MAX" [m]; then a line "x y z Bx By Bz" [m, T] per node, z
/// fastest. YAML format (`.yaml`): dim_x, min_x, max_x, … and the list `data` of [Bx, By, Bz] in
/// the same order. Throws InputError "NAME:LINE: WHY".
FieldGrid read_vfield(const std::filesystem::path& path);
/// Parses the text format.
FieldGrid parse_vfield_text(std::string_view text, std::string_view name);
/// Parses the YAML format.
FieldGrid parse_vfield_yaml(std::string_view text, std::string_view name);

}  // namespace microswarm::actuation
