// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <condition_variable>
#include <filesystem>
#include <mutex>
#include <string>
#include <thread>

#include "microswarm/rig/params/rig_params.hpp"

namespace microswarm {

/// Temperatures of a rig's coils between runs, in a file of the user's state folder
/// ($XDG_STATE_HOME/microswarm, or ~/.local/state/microswarm), one for each coil system file. A
/// thread writes it twice a second while the coils are driven. Coils cool by the wall clock; what a
/// killed program did after its last entry counts as the maximum current. Where nothing is known,
/// the coils are taken at their maximum temperatures. No coil is colder than its surroundings.
class CoilTemperatures {
 public:
  /// Reads the file; with `cold`, the coils are at ambient temperature instead. Throws InputError,
  /// one line, if the file is damaged or the folder cannot be written.
  CoilTemperatures(const Rig& rig, bool cold);
  /// Writes the last temperatures; the coils are at rest from then on.
  ~CoilTemperatures();
  CoilTemperatures(const CoilTemperatures&) = delete;
  CoilTemperatures& operator=(const CoilTemperatures&) = delete;

  /// Present temperatures, one for each coil [°C].
  const Eigen::VectorXd& at_start() const { return at_start_; }
  /// False if the coils were taken at their maximum temperatures.
  bool known() const { return known_; }
  /// Why they were, in one line for people.
  std::string why_hot() const;

  /// Takes the temperatures of the driven coils [°C]; callable from any thread. Throws InputError
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
  std::string why_;  // it could not be written
  std::thread thread_;
};

}  // namespace microswarm
