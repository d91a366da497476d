// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <string>
#include <vector>

#include "microswarm/actuation/coils/coil_system.hpp"

namespace microswarm::rig {

/// Wait for the coil that takes longest to be cold enough.
struct CoolDown {
  double seconds = 0;      ///< 0: all are cold enough; infinity: it never is
  std::size_t coil = 0;    ///< that coil
  double temperature = 0;  ///< now [°C]
  double below = 0;        ///< its limit at the start [°C]
};

/// Time until every coil without current is at most `below` [°C].
CoolDown cool_down_from(const std::vector<actuation::AmplifierParams>& coils,
                        const Eigen::VectorXd& temperatures, const std::vector<double>& below);

/// "cooling: coil y 61.2 °C, 45 °C in about 6.3 min".
std::string to_text(const CoolDown& wait, const actuation::CoilSystem& system);

}  // namespace microswarm::rig
