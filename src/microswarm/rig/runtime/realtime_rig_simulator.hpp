// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <condition_variable>
#include <memory>
#include <mutex>

#include "microswarm/actuation/drivers/coil_driver.hpp"
#include "microswarm/rig/simulation/rig_simulator.hpp"
#include "microswarm/vision/camera/frames.hpp"

namespace microswarm::rig {

/// A RigSimulator in real time: simulated time follows the clock, the camera takes pictures at a
/// fixed rate, and the coils are those of a driver, which may be real hardware.
class RealtimeRigSimulator {
 public:
  /// The scenario's observation delay is ignored, since real time has its own. `driver` drives the
  /// coils; with `idle` the simulated swarm ignores them.
  RealtimeRigSimulator(const experiment::Scenario& scenario, const World& world, const Rig& rig,
                       std::unique_ptr<actuation::CoilDriver> driver, bool idle = false);
  /// Waits until its cameras have been destroyed.
  ~RealtimeRigSimulator();
  RealtimeRigSimulator(const RealtimeRigSimulator&) = delete;
  RealtimeRigSimulator& operator=(const RealtimeRigSimulator&) = delete;

  /// Creates a camera at `rate` [Hz]; the simulator must outlive it.
  std::unique_ptr<vision::FrameSource> camera(double rate);
  actuation::CoilDriver& coils();
  CameraView view() const { return simulator_.camera(); }
  /// Current pose of the swarm (ground truth).
  SwarmPose swarm();

 private:
  class Coils;
  class Camera;

  void catch_up();  // advances to the current time; requires the mutex

  std::mutex mutex_;
  std::condition_variable no_camera_;
  int cameras_ = 0;
  const bool idle_;
  RigSimulator simulator_;
  double now_;  // [s], by steady_seconds()
  std::unique_ptr<Coils> coils_;
};

}  // namespace microswarm::rig
