// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "microswarm/actuation/coils/coil_controller.hpp"
#include "microswarm/core/execution/clock.hpp"
#include "microswarm/rig/watch/fault.hpp"

namespace microswarm::rig {

/// One output of the loop.
struct CoilMoment {
  double t = 0;     ///< [s], by steady_seconds()
  double seen = 0;  ///< arrival of the picture that the command answers [s], same clock
  Command command{};
  actuation::CoilOutput output{};
  double late = 0;        ///< delay after the due time [s]
  double round_trip = 0;  ///< of the driver's exchange [s]
  double driven = 0;      ///< time at which the driver acknowledged the currents [s], same clock
};

/// Rate and limits of a CoilLoop.
struct CoilLoopLimits {
  double rate = 200;        ///< rate of outputs between commands [Hz]
  double deadman = 0.5;     ///< longest time without a command [s]
  int max_trips = 1;        ///< times the coils may switch off by themselves within a window
  double trip_window = 10;  ///< [s]
  double max_pause = 0.3;   ///< longest standstill of the program or the computer [s]
  int priority = 0;         ///< real-time priority of the loop's thread; 0 for none
};

/// Sends currents in real time from its own thread, so that the field continues while a navigator
/// computes. A new command goes out at once, but at least half a period after the last output;
/// later outputs follow it. The loop starts with the first command. It sets the coils to zero
/// permanently if it is stopped, no command arrives for the dead man's time, the driver fails, the
/// coils switched off by themselves too often, the device's own limits leave almost no current, or
/// the program or the computer stood still (a suspension also before the first command, which is
/// then not driven), and on destruction.
class CoilLoop {
 public:
  /// `controller` must outlive the loop and not be used elsewhere. `listener` is called in the
  /// loop's thread after each output; an exception from it is a failure. `suspended` returns the
  /// total time of suspensions [s]; tests replace it.
  CoilLoop(actuation::CoilController& controller, const CoilLoopLimits& limits,
           std::function<void(const CoilMoment&)> listener = {},
           std::function<double()> suspended = suspended_seconds);
  ~CoilLoop();
  CoilLoop(const CoilLoop&) = delete;
  CoilLoop& operator=(const CoilLoop&) = delete;

  /// Sets the command and the position of the swarm among the coils [µm]. `seen` is the arrival of
  /// the picture that it answers [s], by steady_seconds().
  void command(const Command& command, const Eigen::Vector3d& position, double seen = 0);
  /// Sets the frequency of the field from the next output on [Hz]; callable from any thread.
  void set_frequency(double frequency);
  /// Sets the coils to zero permanently; callable from any thread. Returns when they are at zero or
  /// cannot be reached, each time with the report of the first stop.
  actuation::StopReport stop(const std::string& why, FaultKind kind = FaultKind::person);

  /// Waits for `seconds`, or until the loop stops.
  void wait(double seconds);
  /// Why the coils were set to zero; empty while they are driven.
  std::string failure() const { return fault().why; }
  /// The same with its kind.
  Fault fault() const;

 private:
  using Clock = std::chrono::steady_clock;

  void run();
  bool wait_until(std::unique_lock<std::mutex>& lock, Clock::time_point earliest,
                  Clock::time_point due);
  std::string silence(double t) const;
  Fault send(CoilMoment& moment, const Eigen::Vector3d& position, std::optional<double> frequency,
             double dt);

  actuation::CoilController& controller_;
  const CoilLoopLimits limits_;
  std::function<void(const CoilMoment&)> listener_;
  const std::function<double()> suspended_;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  Command command_;
  Eigen::Vector3d place_;
  double seen_ = 0;                  // arrival of its picture [s]
  std::optional<double> frequency_;  // of the field [Hz], if it was set
  bool is_new_ = false;              // whether it was not sent yet
  std::optional<double> commanded_;  // time of the last command [s]
  Fault why_;                        // of the stop
  std::optional<actuation::StopReport> stopped_;
  std::thread thread_;
};

}  // namespace microswarm::rig
