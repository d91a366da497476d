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
#include "microswarm/core/execution/clock.hpp"

namespace microswarm {

/// One output of the loop.
struct CoilMoment {
  double t = 0;     ///< [s], by steady_seconds()
  double seen = 0;  ///< when the picture came that the command answers [s], by the same clock
  Command command;
  CoilOutput output;
  double late = 0;        ///< delay after the due time [s]
  double round_trip = 0;  ///< of the driver [s]
  double driven = 0;      ///< when the driver had the currents [s], by the same clock
};

/// Rate and limits of a CoilLoop.
struct CoilLoopLimits {
  double rate = 200;        ///< of sendings between commands [Hz]
  double deadman = 0.5;     ///< longest time without a command [s]
  int max_trips = 1;        ///< times the coils may have been off by themselves in a window
  double trip_window = 10;  ///< [s]
  double max_pause = 0.3;   ///< longest standstill of the program or the computer [s]
};

/// Sends currents in real time from its own thread, so the field continues while a navigator
/// computes. A new command does not wait for the next sending, but goes out half a period after the
/// last one at the earliest; the later sendings follow it. It starts with the first command. It
/// sets the coils to zero for good when it is stopped, when no command arrives for the dead man's
/// time, when the driver fails, when the coils were off by themselves too often, when the device's
/// own limits leave next to nothing, when the program or the computer stood still (a suspension
/// also before the first command, which is then not driven), and on destruction.
class CoilLoop {
 public:
  /// `controller` must outlive the loop and not be used elsewhere. `heard` is called in the loop's
  /// thread after each output; an exception from it is a failure. `suspended` is the clock of
  /// suspensions [s], another one in a test.
  CoilLoop(CoilController& controller, const CoilLoopLimits& limits,
           std::function<void(const CoilMoment&)> heard = {},
           std::function<double()> suspended = suspended_seconds);
  ~CoilLoop();
  CoilLoop(const CoilLoop&) = delete;
  CoilLoop& operator=(const CoilLoop&) = delete;

  /// Sets the command, and the position of the swarm among the coils [µm]. `seen` is when the
  /// picture came that it answers [s], by steady_seconds().
  void command(const Command& command, const Eigen::Vector3d& place, double seen = 0);
  /// Sets the coils to zero for good; callable from any thread. Returns when they are at zero or
  /// cannot be reached.
  void stop(const std::string& why);

  /// Waits for `seconds`, or until the loop stops.
  void wait(double seconds);
  /// Why the coils are at zero; empty while they are driven.
  std::string failure() const;
  /// After stop(): the device confirmed that the coils are at zero.
  bool zero_is_confirmed() const;
  /// After stop(): CoilDriver::stop_trouble.
  std::string stop_trouble() const;
  /// After stop(): when zero was commanded [s], by steady_seconds().
  double zero_at() const;

 private:
  void run();
  std::string send(CoilMoment& moment, const Eigen::Vector3d& place, double dt);

  CoilController& controller_;
  const CoilLoopLimits limits_;
  std::function<void(const CoilMoment&)> heard_;
  const std::function<double()> suspended_;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  Command command_;
  Eigen::Vector3d place_;
  double seen_ = 0;                  // when its picture came [s]
  bool is_new_ = false;              // not sent yet
  std::optional<double> commanded_;  // when [s]
  std::string why_;                  // reason of the stop
  bool at_zero_ = false;
  bool confirmed_ = false;
  std::string stop_trouble_;
  double zero_at_ = 0;
  std::thread thread_;
};

}  // namespace microswarm
