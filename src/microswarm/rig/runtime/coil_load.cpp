// SPDX-License-Identifier: Apache-2.0
#include "microswarm/rig/runtime/coil_load.hpp"

#include <cmath>

namespace microswarm::rig {

void CoilLoadMeter::take(double t, const actuation::CoilOutput& output) {
  const std::vector<actuation::AmplifierParams>& amplifiers = system_.amplifiers();
  double highest = -1, hottest = -1e300;
  for (Eigen::Index c = 0; c < output.currents.size(); ++c) {
    const double current = std::abs(output.currents[c]);
    const std::optional<double> most = amplifiers[static_cast<std::size_t>(c)].max_current;
    const double share = current / most.value_or(1);
    if (share <= highest) continue;
    highest = share;
    load_.max_current = most;
  }
  share_.add(t, highest);
  load_.current = share_.value() * load_.max_current.value_or(1);
  for (Eigen::Index c = 0; c < output.temperatures.size(); ++c) {
    const actuation::AmplifierParams& amplifier = amplifiers[static_cast<std::size_t>(c)];
    const double below = output.temperatures[c] - amplifier.max_temperature.value_or(1e4);
    if (below <= hottest) continue;
    hottest = below;
    load_.temperature = output.temperatures[c];
    load_.max_temperature = amplifier.max_temperature;
  }
  weakening_.add(t, 1 - output.scale);
  load_.scale = 1 - weakening_.value();
  load_.output = output;
}

}  // namespace microswarm::rig
