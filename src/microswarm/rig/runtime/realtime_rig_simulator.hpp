// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <condition_variable>
#include <memory>
#include <mutex>

#include "microswarm/actuation/drivers/coil_driver.hpp"
#include "microswarm/rig/simulation/rig_simulator.hpp"
#include "microswarm/vision/camera/frames.hpp"

namespace microswarm {

/// A simulated bench in real time: its time passes as the clock does, its camera takes pictures at
/// a rate, and its coils are those of a driver, with what is behind that if it is a real one.
class RealtimeRigSimulator {
 public:
  /// The scenario's observation delay is left out, as real time has its own; `driver` is what the
  /// coils hang on.
  RealtimeRigSimulator(const Scenario& scenario, const World& world, const Rig& rig,
                       std::unique_ptr<CoilDriver> driver);
  /// Waits until its cameras are gone.
  ~RealtimeRigSimulator();
  RealtimeRigSimulator(const RealtimeRigSimulator&) = delete;
  RealtimeRigSimulator& operator=(const RealtimeRigSimulator&) = delete;

  /// Pictures at `rate` [Hz]; the bench outlives it.
  std::unique_ptr<FrameSource> camera(double rate);
  CoilDriver& coils();
  CameraView view() const { return bench_.camera(); }
  /// Where the swarm truly is now.
  SwarmPose swarm();

 private:
  class Coils;
  class Camera;

  void catch_up();  // with the clock; the mutex is held

  std::mutex mutex_;
  std::condition_variable no_camera_;
  int cameras_ = 0;
  RigSimulator bench_;
  double now_;  // [s], by steady_seconds()
  std::unique_ptr<Coils> coils_;
};

}  // namespace microswarm
