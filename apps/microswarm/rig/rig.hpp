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

/// Check for three numbers of magnitude up to `most`; `form` describes the format.
Check triple(const char* form, double most);
/// The numbers of a text accepted by `triple`.
Eigen::Vector3d parse_triple(const std::string& text);

/// The vector as text: "(1, 0, 0)".
std::string triple_text(const Eigen::Vector3d& v);

/// Parses "1,0,0", one current for each coil. Throws InputError.
Eigen::VectorXd parse_currents(const std::string& text, const actuation::CoilSystem& system);

/// Adds `rig map`.
void add_rig_map(Command rig, Action& action);
/// Adds `rig calibrate`.
void add_rig_calibrate(Command rig, Action& action);
/// Adds `rig heat`.
void add_rig_heat(Command rig, Action& action);
/// Adds `rig scale`.
void add_rig_scale(Command rig, Action& action);
/// Adds `rig cameras`.
void add_rig_cameras(Command rig, Action& action);
/// Adds `rig check`.
void add_rig_check(Command rig, Action& action);
/// Adds `rig drive`.
void add_rig_drive(Command rig, Action& action);
/// Adds `rig flash`.
void add_rig_flash(Command rig, Action& action);
/// Adds `rig identify`.
void add_rig_identify(Command rig, Action& action);
/// Adds `rig simulate`.
void add_rig_simulate(Command rig, Action& action);
/// Adds `rig run`.
void add_rig_run(Command rig, Action& action);
/// Adds `rig queue`.
void add_rig_queue(Command rig, Action& action);
/// Adds `rig still`.
void add_rig_still(Command rig, Action& action);
/// Adds `rig see`.
void add_rig_see(Command rig, Action& action);

/// Rounds a rounding error, relative to the maximum magnitude `whole`, to 0.
inline double tidy(double x, double whole) { return std::abs(x) < 1e-12 * whole ? 0.0 : x; }

}  // namespace microswarm::cli
