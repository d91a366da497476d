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

/// Throws InputError if there is no terminal, so no emergency key, and no other emergency stop.
void require_emergency_stop(const CoilOptions& o);

/// Says on stderr how to stop: by keys, of which `keys` are further ones, or from elsewhere.
void note_how_to_stop(bool has_keys, const char* keys);

/// The coils of a rig that are driven by hand. Throws InputError if nobody can stop them or limits
/// are missing, HardwareError if the device fails.
struct Bench {
  Bench(const Rig& of, const CoilOptions& o);

  const Rig& rig;
  std::unique_ptr<CoilDriver> driver;
  std::optional<CoilTemperatures> kept;
  Eigen::VectorXd temperatures;  ///< [°C]
  bool said_how_to_stop = false;
};

/// Says it on stderr if the coils are not known to be at zero, or another than the driver that
/// drove said so (CoilDriver::stop_trouble). Returns whether neither is so.
bool note_zero(bool confirmed, const std::string& stop_trouble);

}  // namespace microswarm::cli
