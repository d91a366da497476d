// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "microswarm/actuation/field/field.hpp"

namespace microswarm::actuation {

/// A multipole: the field −∇Ψ of the potential
/// Ψ = Σ_n (A_n rⁿ + B_n / rⁿ⁺¹) P_n(cos θ), n = 1, 2, …
/// Units are those of calibration files: m, T/A.
struct Multipole {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();    ///< [m]
  Eigen::Vector3d direction = Eigen::Vector3d::UnitZ();  ///< unit vector
  std::vector<double> A{};                               ///< A_n at n − 1
  std::vector<double> B{};                               ///< B_n at n − 1
};

/// Field of one multipole for one ampere. Terms with coefficient 0 contribute nothing anywhere. At
/// the position of a source its unbounded B terms are omitted.
FieldGradient multipole_field(const Multipole& source, const Eigen::Vector3d& position);

/// An electromagnet calibrated as a sum of multipoles.
struct MpemCoil {
  std::string name{};
  std::vector<Multipole> sources{};
};

/// A calibrated system of the multipole electromagnet model (MPEM).
struct MpemSystem {
  std::string name{};
  std::vector<MpemCoil> coils{};
  std::vector<Multipole> offset{};  ///< field at zero current: the coil "Offset" at one ampere
  Eigen::Vector3d lo{}, hi{};       ///< workspace [µm]

  /// Whether a position [µm] is inside the calibrated workspace, border included.
  bool in_workspace(const Eigen::Vector3d& position) const;
};

/// Field of several multipoles.
FieldGradient field_at(const std::vector<Multipole>& sources, const Eigen::Vector3d& position);

/// Reads a calibration in MPEM YAML: Coil_List, and for each coil Source_List and sources with
/// A_Coeff, B_Coeff, Source_Direction and Source_Position. Throws InputError "NAME:LINE:COLUMN:
/// WHY".
MpemSystem read_mpem(const std::filesystem::path& path);
/// Parses the same format from text.
MpemSystem parse_mpem(std::string_view text, std::string_view name);

}  // namespace microswarm::actuation
