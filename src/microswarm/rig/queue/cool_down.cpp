// SPDX-License-Identifier: Apache-2.0
#include "microswarm/rig/queue/cool_down.hpp"

#include <fmt/format.h>

#include "microswarm/actuation/amplifiers/coil_heat.hpp"

namespace microswarm::rig {

CoolDown cool_down_from(const std::vector<actuation::AmplifierParams>& coils,
                        const Eigen::VectorXd& temperatures, const std::vector<double>& below) {
  CoolDown longest;
  for (std::size_t k = 0; k < coils.size(); ++k) {
    const double now = temperatures[static_cast<Eigen::Index>(k)];
    if (now <= below[k]) continue;
    const double seconds = actuation::time_to_cool(coils[k], now, below[k]);
    if (seconds > longest.seconds) longest = {seconds, k, now, below[k]};
  }
  return longest;
}

std::string to_text(const CoolDown& wait, const actuation::CoilSystem& system) {
  const std::string time = wait.seconds < 60 ? fmt::format("{:.0f} s", wait.seconds)
                                             : fmt::format("{:.1f} min", wait.seconds / 60);
  return fmt::format("cooling: coil {} {:.1f} °C, {:.4g} °C in about {}",
                     system.coil_names()[wait.coil], wait.temperature, wait.below, time);
}

}  // namespace microswarm::rig
