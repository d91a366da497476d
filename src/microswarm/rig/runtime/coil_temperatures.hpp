// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <condition_variable>
#include <filesystem>
#include <mutex>
#include <string>
#include <thread>

#include "microswarm/rig/params/rig_params.hpp"

namespace microswarm::rig {

/// Temperatures of a rig's coils between runs, in a file of the user's state folder
/// ($XDG_STATE_HOME/microswarm, or ~/.local/state/microswarm), one for each coil system file. A
/// thread writes it twice a second while the coils are driven. Coils cool by the wall clock; for
/// the time after a killed program's last entry the maximum current is assumed. Without an entry,
/// the coils are assumed at their maximum temperatures. No coil is below ambient temperature.
class CoilTemperatures {
 public:
  /// Reads the file; with `cold`, the coils are at ambient temperature instead. Throws InputError,
  /// one line, if the file is damaged or the folder cannot be written.
  CoilTemperatures(const Rig& rig, bool cold);
  /// Writes the last temperatures and marks the coils as undriven.
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

 private:
  void run();
  void write(const Eigen::VectorXd& temperatures, bool driven) const;

  std::string coils_;
  std::filesystem::path file_;
  Eigen::VectorXd at_start_;
  bool known_ = true;
  std::mutex mutex_;
  std::condition_variable changed_;
  Eigen::VectorXd newest_;
  bool over_ = false;
  std::string why_;  // why the file could not be written
  std::thread thread_;
};

}  // namespace microswarm::rig
