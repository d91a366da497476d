// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "microswarm/experiment/record/record.hpp"
#include "microswarm/rig/params/rig_experiment.hpp"
#include "rig/real_coils.hpp"

namespace microswarm::cli {

/// Options of a drive that identifies a rig.
struct IdentifyDrive {
  bool by_hand = false;
  double seconds = 60;
  std::optional<double> speed{};          ///< [µm/s]; none: the scenario's
  std::optional<double> max_frequency{};  ///< of the sweep [Hz]
  bool drawn_swarm = false;
  CoilOptions coils{};
  std::string out{};  ///< folder of the log of the coils; empty: none
};

/// Result of a drive. Its record has only what was driven up to a fault or a stop.
struct IdentifyOutcome {
  int code = 0;  ///< exit code; the record is complete if it is `ok`
  experiment::Record record{};
};

/// Drives a rig in real time: a programme, or by hand with the keys of `rig run`. The coils are at
/// zero afterwards. Throws InputError if there is no room for the programme.
IdentifyOutcome drive_to_identify(const rig::RigExperiment& on, const IdentifyDrive& drive,
                                  const Context& context);

}  // namespace microswarm::cli
