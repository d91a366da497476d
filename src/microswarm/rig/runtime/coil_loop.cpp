// SPDX-License-Identifier: Apache-2.0
#include "microswarm/rig/runtime/coil_loop.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <exception>
#include <utility>

#include "microswarm/core/errors/write_error.hpp"
#include "microswarm/core/execution/clock.hpp"
#include "microswarm/core/execution/priority.hpp"
#include "microswarm/rig/runtime/device_limits.hpp"
#include "microswarm/rig/runtime/standstill.hpp"

namespace microswarm::rig {
namespace {

using Seconds = std::chrono::duration<double>;

/// Counts how often the coils had switched off by themselves.
class Trips {
 public:
  explicit Trips(const CoilLoopLimits& limits) : limits_(limits) {}
  /// Takes an output. Returns why there are too many trips, or an empty string.
  std::string take(const CoilMoment& moment) {
    if (moment.output.status != actuation::DriveStatus::resumed) return {};
    std::erase_if(times_, [&](double t) { return t < moment.t - limits_.trip_window; });
    times_.push_back(moment.t);
    if (std::ssize(times_) <= limits_.max_trips) return {};
    return fmt::format("the coils had switched off by themselves {} times in {:g} s, allowed {}",
                       times_.size(), limits_.trip_window, limits_.max_trips);
  }

 private:
  CoilLoopLimits limits_;
  std::vector<double> times_;
};

}  // namespace

CoilLoop::CoilLoop(actuation::CoilController& controller, const CoilLoopLimits& limits,
                   std::function<void(const CoilMoment&)> listener,
                   std::function<double()> suspended)
    : controller_(controller),
      limits_(limits),
      listener_(std::move(listener)),
      suspended_(std::move(suspended)),
      place_(controller.place()),
      thread_([this] { run(); }) {}

CoilLoop::~CoilLoop() {
  stop("ended");
  thread_.join();
}

void CoilLoop::command(const Command& command, const Eigen::Vector3d& position, double seen) {
  const std::lock_guard lock(mutex_);
  command_ = command;
  place_ = position;
  seen_ = seen;
  commanded_ = steady_seconds();
  is_new_ = true;
  changed_.notify_all();
}

void CoilLoop::set_frequency(double frequency) {
  const std::lock_guard lock(mutex_);
  frequency_ = frequency;
}

actuation::StopReport CoilLoop::stop(const std::string& why, FaultKind kind) {
  std::unique_lock lock(mutex_);
  if (why_.why.empty()) {
    why_ = {why, kind};
    controller_.interrupt();
  }
  changed_.notify_all();
  changed_.wait(lock, [this] { return stopped_.has_value(); });
  return *stopped_;
}

void CoilLoop::wait(double seconds) {
  std::unique_lock lock(mutex_);
  changed_.wait_for(lock, Seconds(std::max(0.0, seconds)), [this] { return !why_.why.empty(); });
}

Fault CoilLoop::fault() const {
  const std::lock_guard lock(mutex_);
  return why_;
}

void CoilLoop::run() {
  const RealtimePriority priority(limits_.priority);
  const auto period = std::chrono::duration_cast<Clock::duration>(Seconds(1 / limits_.rate));
  auto due = Clock::now();
  auto last = due;
  Standstill standstill(limits_.max_pause, suspended_);
  Trips trips(limits_);
  DeviceLimits device_limits;
  std::unique_lock lock(mutex_);
  while (why_.why.empty()) {
    due += period;
    const double wait = std::max(0.0, Seconds(due - Clock::now()).count());
    if (!wait_until(lock, last + period / 2, due)) break;
    const auto now = Clock::now();
    due = std::min(due, now);
    if (!commanded_) {
      due = last = now;
      standstill.pass(0);  // nothing is driven yet; a suspension takes effect at the first command
      continue;
    }
    CoilMoment moment{.t = steady_seconds(),
                      .seen = seen_,
                      .command = command_,
                      .output = {},
                      .late = Seconds(now - due).count()};
    const Eigen::Vector3d position = place_;
    const std::optional<double> frequency = frequency_;
    why_ = first_fault(
        {{standstill.pass(wait), FaultKind::computer}, {silence(moment.t), FaultKind::computer}});
    if (!why_.why.empty()) break;
    is_new_ = false;
    lock.unlock();
    const Fault failed = send(moment, position, frequency, Seconds(now - last).count());
    last = now;
    if (now > due + period) due = now;  // do not make up for missed outputs
    // An exchange without an answer takes long; one with an answer is short, or the coils were
    // off meanwhile.
    const bool answered = moment.output.status != actuation::DriveStatus::no_answer;
    const Fault why =
        first_fault({failed,
                     {controller_.trouble(), FaultKind::device},
                     {standstill.pass(answered ? 0 : moment.round_trip), FaultKind::computer},
                     {device_limits.take(moment.t, moment.output), FaultKind::device},
                     {trips.take(moment), FaultKind::device}});
    lock.lock();
    if (why_.why.empty()) why_ = why;
  }
  lock.unlock();
  actuation::StopReport report = controller_.stop();
  lock.lock();
  stopped_ = std::move(report);
  changed_.notify_all();
}

/// Waits until `due`, or from `earliest` on for a new command. False if the loop is stopped.
bool CoilLoop::wait_until(std::unique_lock<std::mutex>& lock, Clock::time_point earliest,
                          Clock::time_point due) {
  const auto stopped = [this] { return !why_.why.empty(); };
  if (changed_.wait_until(lock, earliest, stopped)) return false;
  changed_.wait_until(lock, due, [&] { return is_new_ || stopped(); });
  return !stopped();
}

/// Why too much time has passed at `t` [s] since the last command; empty if it has not.
std::string CoilLoop::silence(double t) const {
  const double silent = t - *commanded_;
  return silent > limits_.deadman ? fmt::format("no command for {:.2g} s", silent) : "";
}

/// Message of an exception; empty on success. Only a listener writes.
Fault CoilLoop::send(CoilMoment& moment, const Eigen::Vector3d& position,
                     std::optional<double> frequency, double dt) {
  try {
    if (frequency) controller_.set_frequency(*frequency);
    controller_.aim(position);
    controller_.command(moment.command);
    const double began = steady_seconds();
    moment.output = controller_.advance(dt);
    moment.driven = steady_seconds();
    moment.round_trip = moment.driven - began;
    if (actuation::trouble_text(moment.output.status).empty() && listener_) listener_(moment);
    return {};
  } catch (const WriteError& e) {
    return {e.what(), FaultKind::disk};
  } catch (const std::exception& e) {
    return {e.what(), FaultKind::device};
  }
}

}  // namespace microswarm::rig
