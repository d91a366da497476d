// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <string>

#include "microswarm/actuation/coils/coil_system.hpp"
#include "support/cli.hpp"
#include "support/command.hpp"

namespace microswarm::cli {

inline constexpr double max_place = 1e9;  ///< [µm]
inline constexpr double max_field = 1e6;  ///< [mT]

/// Allows three numbers up to `most`; `form` says what is meant.
Check triple(const char* form, double most);
/// What it allowed.
Eigen::Vector3d triple_of(const std::string& text);

/// The numbers in "1,0,0", one for each coil. Throws InputError.
Eigen::VectorXd currents_of(const std::string& text, const CoilSystem& system);

/// The part `rig map` of `rig`.
void add_rig_map(Command rig, Action& action);
/// The part `rig scale` of `rig`.
void add_rig_scale(Command rig, Action& action);
/// The part `rig check` of `rig`.
void add_rig_check(Command rig, Action& action);
/// The part `rig simulate` of `rig`.
void add_rig_simulate(Command rig, Action& action);
/// The part `rig run` of `rig`.
void add_rig_run(Command rig, Action& action);
/// The part `rig see` of `rig`.
void add_rig_see(Command rig, Action& action);

/// Without what is only rounding beside `whole`, the largest that could be there.
inline double tidy(double x, double whole) { return std::abs(x) < 1e-12 * whole ? 0.0 : x; }

}  // namespace microswarm::cli
