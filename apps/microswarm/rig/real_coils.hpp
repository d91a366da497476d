// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "microswarm/rig/runtime/coil_temperatures.hpp"
#include "microswarm/rig/runtime/devices.hpp"
#include "support/cli.hpp"
#include "support/command.hpp"

namespace microswarm::cli {

/// Options of every command that drives coils.
struct CoilOptions {
  bool without_limits = false;
  bool coils_cold = false;
  bool other_stop = false;
};

/// Adds --without-limits, --coils-cold and --other-stop.
void add_coil_options(Command cmd, CoilOptions& o);

/// Throws InputError without a terminal, so without an emergency key, unless --other-stop is given.
void require_emergency_stop(const CoilOptions& o);

/// Throws InputError unless driving the rig's coils is intended and somebody can stop them.
void require_person(const rig::Rig& rig, const CoilOptions& o, bool dry, bool drawn_swarm);

/// Prints on stderr how to stop: by the emergency keys, with further `keys`, or from elsewhere.
void note_how_to_stop(bool has_keys, const char* keys);

/// The coils of a rig for manual driving. Throws InputError if nobody can stop them or limits are
/// missing, HardwareError if the device fails.
struct Bench {
  Bench(const rig::Rig& of, const CoilOptions& o);

  const rig::Rig& rig;
  std::unique_ptr<actuation::CoilDriver> driver;
  std::optional<rig::CoilTemperatures> kept;
  Eigen::VectorXd temperatures;  ///< [°C]
  bool said_how_to_stop = false;
};

/// Warns on stderr if zero currents are not confirmed, or a fallback driver confirmed them. Returns
/// whether there was no reason to warn.
bool note_zero(const actuation::StopReport& zero);

}  // namespace microswarm::cli
