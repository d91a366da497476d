// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <termios.h>

#include <atomic>
#include <functional>
#include <memory>
#include <optional>
#include <thread>

#include "microswarm/rig/runtime/coil_temperatures.hpp"
#include "microswarm/rig/runtime/devices.hpp"
#include "support/cli.hpp"
#include "support/command.hpp"

namespace microswarm::cli {

/// Calls `stop` when a key is pressed, if the program has a terminal. The terminal settings are
/// restored when the program is asked to end.
class EmergencyKey {
 public:
  EmergencyKey(std::function<void()> stop, const Stop& ended);
  ~EmergencyKey();
  EmergencyKey(const EmergencyKey&) = delete;
  EmergencyKey& operator=(const EmergencyKey&) = delete;
  bool is_there() const { return thread_.joinable(); }

 private:
  void listen();

  std::function<void()> stop_;
  Stop ended_;
  termios before_{};
  std::atomic<bool> over_ = false;
  std::thread thread_;
};

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

/// The coils of a rig that are driven by hand. Throws InputError if nobody can stop them or limits
/// are missing, HardwareError if the device fails.
struct Bench {
  Bench(const Rig& of, const CoilOptions& o);

  const Rig& rig;
  std::unique_ptr<CoilDriver> driver;
  std::optional<CoilTemperatures> kept;
  Eigen::VectorXd temperatures;  ///< [°C]
};

/// Says it on stderr if the coils are not known to be at zero. Returns whether they are.
bool note_zero(bool confirmed);

}  // namespace microswarm::cli
