// SPDX-License-Identifier: Apache-2.0
#include "microswarm/actuation/coils/coil_controller.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <span>
#include <utility>

#include "microswarm/actuation/coils/currents.hpp"
#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/execution/clock.hpp"
#include "microswarm/core/fields/overloaded.hpp"

namespace microswarm::actuation {
namespace {

/// Sends turning currents to a driver that makes waveforms; channels without a coil get no current.
DriveStatus send(CoilDriver& driver, const TurningCurrents& currents) {
  const auto channels = [&](const Eigen::VectorXd& part) {
    std::vector<double> list(static_cast<std::size_t>(driver.capabilities().channels));
    std::ranges::copy(part, list.begin());
    return list;
  };
  const std::vector<double> constant = channels(currents.constant);
  const std::vector<double> cosine = channels(currents.cosine), sine = channels(currents.sine);
  return driver.drive(CurrentWaveform{currents.frequency, currents.phase, constant, cosine, sine});
}

}  // namespace

CoilController::CoilController(const CoilSystem& system, const FieldGeneratorParams& field,
                               CoilDriver& driver, double heading)
    : system_(system),
      driver_(driver),
      generator_(field, heading),
      amplifiers_(system.amplifiers()),
      place_(system.centre()),
      actuation_(system.at(place_)),
      channels_(static_cast<std::size_t>(driver.capabilities().channels)) {
  if (system.size() > channels_.size())
    throw InputError(fmt::format("the system has {} coils, the driver {} channels", system.size(),
                                 channels_.size()));
  output_.currents = amplifiers_.currents();
  output_.acknowledged = Eigen::VectorXd::Zero(output_.currents.size());
}

CoilController::~CoilController() {
  if (!at_zero_) stop();
}

void CoilController::aim(const Eigen::Vector3d& position) {
  constexpr double same_place = 50;  // [µm]; the field of a coil is constant over such a distance
  if ((position - place_).norm() < same_place) return;
  place_ = position;
  actuation_ = system_.at(position);
}

void CoilController::command(Setpoint setpoint) {
  setpoint_ = std::move(setpoint);
  if (const auto* const command = std::get_if<Command>(&setpoint_)) generator_.command(*command);
}

const CoilOutput& CoilController::advance(double dt, double share) {
  at_zero_ = false;
  if (turns_on_device())
    send_waveform(dt, share);
  else
    send_currents(dt, share);
  misses_ = output_.status == DriveStatus::no_answer ? misses_ + 1 : 0;
  output_.currents = amplifiers_.currents();
  if (is_acknowledged(output_.status)) {
    mind_probes();
    output_.device_scale = driver_.report().scale;
    output_.acknowledged = output_.device_scale * output_.currents;
  }
  output_.temperatures = amplifiers_.temperatures();
  return output_;
}

/// Warms the model where a probe shows more than it. A probe on a coil's surface shows less than
/// the winding has, so it never cools the model.
void CoilController::mind_probes() {
  const std::vector<double>& probes = driver_.report().temperatures;
  Eigen::VectorXd temperatures = amplifiers_.temperatures();
  const auto count = std::min(probes.size(), static_cast<std::size_t>(temperatures.size()));
  bool is_warmer = false;
  for (std::size_t k = 0; k < count; ++k) {
    double& model = temperatures[static_cast<Eigen::Index>(k)];
    if (!(probes[k] > model)) continue;  // NaN without a probe
    model = probes[k];
    is_warmer = true;
  }
  if (is_warmer) amplifiers_.warm(temperatures);
  output_.probe_trouble = driver_.report().probe_trouble;
}

/// Whether the device turns the setpoint's field.
bool CoilController::turns_on_device() const {
  return driver_.capabilities().input == CoilInput::waveform &&
         std::holds_alternative<Command>(setpoint_);
}

/// Currents that make a field.
Eigen::VectorXd CoilController::make(const Eigen::Vector3d& field) {
  CurrentsForField found = currents_for(actuation_, field);
  output_.wanted = field;
  output_.reached = found.reached;
  return std::move(found.currents);
}

/// Currents of the setpoint after `dt` seconds, without the limits.
Eigen::VectorXd CoilController::wanted_currents(double dt) {
  return std::visit(Overloaded{[&](const Command&) { return make(generator_.advance(dt)); },
                               [&](const Eigen::Vector3d& field) { return make(field); },
                               [&](const Eigen::VectorXd& currents) {
                                 output_.wanted = actuation_.total_field(currents);
                                 output_.reached = true;
                                 return currents;
                               }},
                    setpoint_);
}

void CoilController::send_currents(double dt, double share) {
  const LimitedCurrents limited = amplifiers_.step(share * wanted_currents(dt), dt);
  output_.scale = limited.scale;
  std::copy(limited.currents.begin(), limited.currents.end(), channels_.begin());
  const Eigen::Vector3d field = actuation_.field * limited.currents;
  output_.status = driver_.drive(constant_request(
      driver_.capabilities(), std::span<const double, 3>(field.data(), 3), channels_));
}

void CoilController::send_waveform(double dt, double share) {
  output_.wanted = generator_.advance(dt);
  const TurningCurrents wanted = turning_currents(actuation_, generator_, output_.reached);
  output_.scale = amplifiers_.turn(wanted.scaled(share), dt);
  output_.status = send(driver_, amplifiers_.turning());
  if (const auto phase = driver_.report().phase) generator_.follow_phase(*phase);
}

std::string CoilController::trouble() const {
  const bool waits = output_.status == DriveStatus::no_answer && misses_ < max_missed_answers;
  return waits ? std::string() : trouble_text(driver_, output_.status);
}

StopReport CoilController::stop() noexcept {
  amplifiers_.cut();
  output_.currents.setZero();
  output_.acknowledged.setZero();
  StopReport report = driver_.stop();
  report.at = steady_seconds();
  at_zero_ = report.confirmed;
  return report;
}

}  // namespace microswarm::actuation
