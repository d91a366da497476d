// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <atomic>
#include <condition_variable>
#include <filesystem>
#include <mutex>
#include <string>
#include <thread>

#include "microswarm/actuation/drivers/coil_driver.hpp"
#include "microswarm/core/execution/inheriting_mutex.hpp"
#include "microswarm/rig/params/rig_params.hpp"
#include "microswarm/rig/runtime/clock_reading.hpp"

namespace microswarm::rig {

/// Identity of a rig's coils: the `id` of their file, which copies of it keep, otherwise its path.
std::string coil_identity(const Rig& rig);

/// Temperatures of a rig's coils now by the file that CoilTemperatures keeps, one for each coil
/// [°C]; the maximum ones without a file. Writes nothing. Throws InputError if it is damaged.
Eigen::VectorXd kept_temperatures(const Rig& rig, const ClockReading& now = read_clocks());

/// Temperatures of a rig's coils between runs, in a file of the user's state folder
/// ($XDG_STATE_HOME/microswarm, or ~/.local/state/microswarm), one for each identity of coils. A
/// thread writes it twice a second while the coils are driven. Coils cool by the time that has
/// passed for certain; for the time after a killed program's last entry the maximum current is
/// assumed. Without an entry, the coils are assumed at their maximum temperatures. No coil is below
/// ambient temperature.
class CoilTemperatures {
 public:
  /// Reads the file; with `cold`, the coils are at ambient temperature instead. Throws InputError,
  /// one line, if the file is damaged, is of another number of coils or the folder cannot be
  /// written, and with `cold` if the file knows that a coil is warmer. With `cold` a damaged file
  /// counts as none.
  CoilTemperatures(const Rig& rig, bool cold, const ClockReading& now = read_clocks());
  /// Writes the last temperatures, and that the coils are undriven if they were last seen at zero.
  ~CoilTemperatures();
  CoilTemperatures(const CoilTemperatures&) = delete;
  CoilTemperatures& operator=(const CoilTemperatures&) = delete;

  /// Temperatures at the start, one for each coil [°C].
  const Eigen::VectorXd& at_start() const { return at_start_; }
  /// False if the maximum temperatures were assumed.
  bool known() const { return known_; }
  /// Why they were assumed, as a message of one line.
  std::string why_hot() const;

  /// Stores the temperatures of the driven coils [°C]; callable from any thread. Throws InputError
  /// if the file could not be written.
  void take(const Eigen::VectorXd& temperatures);

  /// Takes a stop of the coils. Until one is confirmed, they count as driven.
  void take(const actuation::StopReport& stop);

 private:
  void require_nothing_warmer(const ClockReading& now) const;
  void run();
  void write(const Eigen::VectorXd& temperatures, bool driven) const;

  std::vector<actuation::AmplifierParams> amplifiers_;
  std::string coils_;
  std::filesystem::path file_;
  double began_;  ///< uptime at the start [s]
  Eigen::VectorXd at_start_;
  bool known_ = true;
  std::atomic<bool> assumed_{false};  ///< nothing was known, and no current flowed since
  InheritingMutex mutex_;
  std::condition_variable_any changed_;
  Eigen::VectorXd newest_;
  bool over_ = false;
  bool at_zero_ = true;
  std::string why_;  // why the file could not be written
  std::thread thread_;
};

}  // namespace microswarm::rig
