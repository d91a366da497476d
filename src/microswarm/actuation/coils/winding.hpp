// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "microswarm/actuation/coils/current_loop.hpp"
#include "microswarm/core/errors/issue.hpp"
#include "microswarm/core/fields/fields.hpp"

namespace microswarm::actuation {

/// Turns of wire around one axis: a thin loop, or a solenoid if length or thickness is set. The
/// turns fill the cross-section evenly. The middle turn has `radius`.
struct WindingParams {
  std::vector<double> centre{0, 0, 0};
  std::vector<double> axis{0, 0, 1};
  double radius = 50000;
  double turns = 1;
  double length = 0;
  double thickness = 0;
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.centre, um("centre", -1e8, 1e8, "Middle of the winding, [x, y, z]."));
    visit(self.axis,
          plain("axis", -1e6, 1e6, "Direction of the field for a positive current, [x, y, z]."));
    visit(self.radius, um("radius", 1, 1e8, "Radius of the middle turn.").needed());
    visit(self.turns, plain("turns", 1e-3, 1e6, "Number of turns."));
    visit(self.length, um("length", 0, 1e8, "Length along the axis; 0: a thin loop."));
    visit(self.thickness, um("thickness", 0, 1e8, "Outer less inner radius; 0: a thin layer."));
  }
};

/// A coil: windings that carry one common current.
struct CoilParams {
  std::string name{};
  std::vector<WindingParams> windings{};
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.name, plain("name", "Name of the coil.").needed());
    visit(self.windings, plain("windings", "Windings in series.").needed());
  }
};

/// Loops that approximate a winding. The field is exact to about 1e-9 at distances above half the
/// winding's length and thickness. Reports invalid parameters to `issues`.
std::vector<CurrentLoop> to_loops(const WindingParams& winding, Issues& issues);

/// Field of several loops for one ampere.
FieldGradient field_at(const std::vector<CurrentLoop>& loops, const Eigen::Vector3d& position);

/// List of three numbers as a vector; otherwise the issue "KEY has 2 numbers, must be [x, y, z]".
Eigen::Vector3d to_vector(const std::vector<double>& numbers, std::string_view key, Issues& issues);

}  // namespace microswarm::actuation
