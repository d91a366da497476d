// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "microswarm/actuation/field/field_generator.hpp"
#include "microswarm/contracts/command.hpp"
#include "microswarm/geometry/vec2.hpp"

namespace microswarm::rig {

/// A command and the frequency of the field, valid until the next one.
struct DrivenCommand {
  double t = 0;  ///< [s]
  Command command{};
  double frequency = 0;  ///< turns per second, or their maximum for a rolling field [Hz]
};

/// The swarm in a picture.
struct Sighting {
  double t = 0;     ///< of the picture, by the clock of the commands [s]
  Vec2 position{};  ///< [µm]
};

/// Commands and sightings, the input of the fits. Both lists are in the order of time.
struct ResponseData {
  actuation::FieldGeneratorParams field{};  ///< with the usual frequency
  std::vector<DrivenCommand> commands{};
  std::vector<Sighting> seen{};
};

}  // namespace microswarm::rig
