// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "microswarm/actuation/coils/coil_system.hpp"

namespace microswarm::cli {

/// Positions of a probe [µm] in "X,Y,Z;X,Y,Z" or in a CSV file; the system's centre without any.
/// Throws InputError.
std::vector<Eigen::Vector3d> probe_positions(const std::string& given,
                                             const actuation::CoilSystem& system);

}  // namespace microswarm::cli
