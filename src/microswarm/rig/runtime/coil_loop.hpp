// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <condition_variable>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "microswarm/actuation/coils/coil_controller.hpp"

namespace microswarm {

/// What the loop sent, and when.
struct CoilMoment {
  double t = 0;  ///< [s], by steady_seconds()
  Command command;
  CoilOutput output;
  double late = 0;        ///< after it was due [s]
  double round_trip = 0;  ///< that the driver took [s]
};

/// Sends currents in real time, in a thread of its own, so that the field goes on while a navigator
/// thinks. It begins with the first command. The coils go to zero for good when it is told to stop,
/// when no command came for `deadman` seconds, when the driver fails, and when it is destroyed.
class CoilLoop {
 public:
  /// The controller outlives it and is used by nobody else meanwhile. `heard` is called in the
  /// loop's thread with each moment; what it throws is a failure. `rate` [Hz], `deadman` [s].
  CoilLoop(CoilController& controller, double rate, double deadman,
           std::function<void(const CoilMoment&)> heard = {});
  ~CoilLoop();
  CoilLoop(const CoilLoop&) = delete;
  CoilLoop& operator=(const CoilLoop&) = delete;

  /// The command from now on, for a swarm at this place among the coils [µm].
  void command(const Command& command, const Eigen::Vector3d& place);
  /// Coils to zero, for good; from any thread. Returns when they are, or cannot be reached.
  void stop(const std::string& why);

  /// Waits for `seconds`, or until it stops.
  void wait(double seconds);
  /// Why the coils are at zero; empty while they are driven.
  std::string failure() const;
  /// After stop(): the device said that the coils are at zero.
  bool zero_is_confirmed() const;
  /// After stop(): when they were told so [s], by steady_seconds().
  double zero_at() const;

 private:
  void run();
  std::string send(CoilMoment& moment, const Eigen::Vector3d& place, double dt);

  CoilController& controller_;
  const double period_;
  const double deadman_;
  std::function<void(const CoilMoment&)> heard_;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  Command command_;
  Eigen::Vector3d place_;
  std::optional<double> commanded_;  // when [s]
  std::string why_;                  // it stops
  bool at_zero_ = false;
  bool confirmed_ = false;
  double zero_at_ = 0;
  std::thread thread_;
};

}  // namespace microswarm
