// SPDX-License-Identifier: Apache-2.0
#include "microswarm/rig/runtime/realtime_rig_simulator.hpp"

#include <algorithm>
#include <chrono>
#include <optional>
#include <thread>

#include "microswarm/actuation/amplifiers/amplifiers.hpp"
#include "microswarm/core/execution/clock.hpp"
#include "microswarm/core/maths/angles.hpp"
#include "microswarm/vision/camera/newest_frame.hpp"

namespace microswarm::rig {
namespace {

constexpr double longest_step = 0.005;  // [s]

experiment::Scenario without_delay(experiment::Scenario scenario) {
  scenario.sensing.observation_delay = scenario.sensing.hidden_delay = 0;
  return scenario;
}

}  // namespace

/// Wraps the driver and advances the simulation after each call.
class RealtimeRigSimulator::Coils : public actuation::CoilDriver {
 public:
  Coils(RealtimeRigSimulator& owner, std::unique_ptr<actuation::CoilDriver> driver)
      : owner_(owner), driver_(std::move(driver)) {}

  actuation::Capabilities capabilities() const override { return driver_->capabilities(); }
  const actuation::DeviceReport& report() const override { return driver_->report(); }
  actuation::DriveStatus drive(const actuation::CoilRequest& request) override {
    const std::lock_guard lock(owner_.mutex_);
    owner_.catch_up();
    turning_.reset();
    const actuation::DriveStatus status = driver_->drive(request);
    const auto* const waveform = std::get_if<actuation::CurrentWaveform>(&request);
    if (waveform && actuation::is_acknowledged(status)) turn(*waveform);
    return status;
  }
  /// Currents of the coils at a time [s]; a waveform continues between two messages.
  std::span<const double> currents_at(double t) {
    if (!turning_) return report().currents;
    actuation::TurningCurrents then = *turning_;
    then.phase += 2 * pi * then.frequency * (t - told_at_);
    now_ = then.now();
    return {now_.data(), static_cast<std::size_t>(now_.size())};
  }
  actuation::StopReport stop() noexcept override {
    const std::lock_guard lock(owner_.mutex_);
    turning_.reset();
    // Nothing may fail here; the simulation catches up later, without current.
    return driver_->stop();
  }
  void interrupt() noexcept override { driver_->interrupt(); }

 private:
  /// Notes the waveform as the device turns it.
  void turn(const actuation::CurrentWaveform& waveform) {
    const actuation::DeviceReport& device = report();
    if (!device.phase) return;
    const auto vector = [&](std::span<const double> values) {
      return Eigen::VectorXd(device.scale *
                             Eigen::Map<const Eigen::VectorXd>(
                                 values.data(), static_cast<Eigen::Index>(values.size())));
    };
    turning_ = {.frequency = waveform.frequency,
                .phase = *device.phase,
                .constant = vector(waveform.constant),
                .cosine = vector(waveform.cosine),
                .sine = vector(waveform.sine)};
    told_at_ = steady_seconds();
  }

  RealtimeRigSimulator& owner_;
  std::unique_ptr<actuation::CoilDriver> driver_;
  std::optional<actuation::TurningCurrents> turning_;  // acknowledged
  double told_at_ = 0;  // time of that message [s], by steady_seconds()
  Eigen::VectorXd now_;
};

class RealtimeRigSimulator::Camera : public vision::FrameSource {
 public:
  Camera(RealtimeRigSimulator& owner, double rate)
      : owner_(owner), rate_(rate), due_(steady_seconds()) {
    const std::lock_guard lock(owner_.mutex_);
    ++owner_.cameras_;
  }
  ~Camera() override {
    const std::lock_guard lock(owner_.mutex_);
    --owner_.cameras_;
    owner_.no_camera_.notify_all();
  }
  Camera(const Camera&) = delete;
  Camera& operator=(const Camera&) = delete;

  bool next(vision::VideoFrame& frame) override {
    due_ = std::max(due_ + 1 / rate_, steady_seconds());
    std::this_thread::sleep_for(std::chrono::duration<double>(due_ - steady_seconds()));
    std::unique_lock lock(owner_.mutex_);
    owner_.catch_up();
    const RigSimulator::Shot shot = owner_.simulator_.capture();
    lock.unlock();
    frame.index = index_++;
    frame.t = shot.now;
    frame.picture = owner_.simulator_.render(shot);
    return true;
  }
  std::optional<int> count() const override { return std::nullopt; }
  std::optional<double> rate() const override { return rate_; }

 private:
  RealtimeRigSimulator& owner_;
  double rate_;
  double due_;
  int index_ = 0;
};

RealtimeRigSimulator::RealtimeRigSimulator(const experiment::Scenario& scenario, const World& world,
                                           const Rig& rig,
                                           std::unique_ptr<actuation::CoilDriver> driver, bool idle)
    : idle_(idle),
      simulator_(without_delay(scenario), world, rig),
      now_(steady_seconds()),
      coils_(std::make_unique<Coils>(*this, std::move(driver))) {}

RealtimeRigSimulator::~RealtimeRigSimulator() {
  std::unique_lock lock(mutex_);
  no_camera_.wait(lock, [this] { return cameras_ == 0; });
}

std::unique_ptr<vision::FrameSource> RealtimeRigSimulator::camera(double rate) {
  return std::make_unique<Camera>(*this, rate);
}

actuation::CoilDriver& RealtimeRigSimulator::coils() { return *coils_; }

SwarmPose RealtimeRigSimulator::swarm() {
  const std::lock_guard lock(mutex_);
  catch_up();
  return simulator_.ground_truth().swarm;
}

void RealtimeRigSimulator::catch_up() {
  const double now = steady_seconds();
  const std::vector<double> off(
      static_cast<std::size_t>(idle_ ? coils_->capabilities().channels : 0));
  simulator_.start_trajectory();
  while (now - now_ > 1e-6) {
    const double step = std::min(longest_step, now - now_);
    simulator_.pass(idle_ ? std::span<const double>(off) : coils_->currents_at(now_), step);
    now_ += step;
  }
}

}  // namespace microswarm::rig
