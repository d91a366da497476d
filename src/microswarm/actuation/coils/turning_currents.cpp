// SPDX-License-Identifier: Apache-2.0
#include "microswarm/actuation/coils/turning_currents.hpp"

#include <algorithm>
#include <vector>

#include "microswarm/actuation/coils/currents.hpp"

namespace microswarm {

TurningCurrents turning_currents(const Actuation& at, const FieldGenerator& generator,
                                 bool& reached) {
  const auto [cosine, sine] = generator.turning();
  const CurrentsForField none = currents_for(at, Eigen::Vector3d::Zero());
  const CurrentsForField along = currents_for(at, cosine), across = currents_for(at, sine);
  reached = along.reached && across.reached;
  return {.frequency = generator.frequency(),
          .max_frequency = generator.max_frequency(),
          .phase = generator.phase(),
          .constant = none.currents,
          .cosine = along.currents - none.currents,
          .sine = across.currents - none.currents};
}

DriveStatus send(CoilDriver& driver, const TurningCurrents& currents) {
  const auto channels = [&](const Eigen::VectorXd& part) {
    std::vector<double> list(static_cast<std::size_t>(driver.capabilities().channels));
    std::ranges::copy(part, list.begin());
    return list;
  };
  const std::vector<double> constant = channels(currents.constant);
  const std::vector<double> cosine = channels(currents.cosine), sine = channels(currents.sine);
  return driver.drive(CurrentWaveform{currents.frequency, currents.phase, constant, cosine, sine});
}

}  // namespace microswarm
