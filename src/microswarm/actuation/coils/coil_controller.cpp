// SPDX-License-Identifier: Apache-2.0
#include "microswarm/actuation/coils/coil_controller.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <span>

#include "microswarm/actuation/coils/currents.hpp"
#include "microswarm/actuation/coils/turning_currents.hpp"
#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/execution/clock.hpp"

namespace microswarm {

void take_answer(const CoilDriver& driver, CoilOutput& output) {
  if (!is_acknowledged(output.status)) return;
  output.device_scale = driver.report().scale;
  output.acknowledged = output.device_scale * output.currents;
}

CoilController::CoilController(const CoilSystem& system, const FieldGeneratorParams& field,
                               CoilDriver& driver, double heading)
    : system_(system),
      driver_(driver),
      generator_(field, heading),
      drive_(system.drives()),
      place_(system.centre()),
      actuation_(system.at(place_)),
      channels_(static_cast<std::size_t>(driver.capabilities().channels)) {
  if (system.size() > channels_.size())
    throw InputError(fmt::format("the system has {} coils, the driver {} channels", system.size(),
                                 channels_.size()));
  output_.currents = drive_.currents();
  output_.acknowledged = Eigen::VectorXd::Zero(output_.currents.size());
}

CoilController::~CoilController() { stop(); }

void CoilController::aim(const Eigen::Vector3d& position) {
  constexpr double same_place = 50;  // [µm]; the field of a coil is constant over such a distance
  if ((position - place_).norm() < same_place) return;
  place_ = position;
  actuation_ = system_.at(position);
}

const CoilOutput& CoilController::advance(double dt) {
  output_.wanted = generator_.advance(dt);
  if (driver_.capabilities().input == CoilInput::waveform)
    send_waveform(dt);
  else
    send_currents(dt);
  take_answer(driver_, output_);
  output_.temperatures = drive_.temperatures();
  return output_;
}

void CoilController::send_currents(double dt) {
  const CurrentsForField found = currents_for(actuation_, output_.wanted);
  const DrivenCurrents driven = drive_.step(found.currents, dt);
  output_.currents = driven.currents;
  output_.scale = driven.scale;
  output_.reached = found.reached;
  std::copy(driven.currents.begin(), driven.currents.end(), channels_.begin());
  const Eigen::Vector3d field = actuation_.field * driven.currents;
  output_.status = driver_.drive(constant_request(
      driver_.capabilities(), std::span<const double, 3>(field.data(), 3), channels_));
}

void CoilController::send_waveform(double dt) {
  output_.scale = drive_.turn(turning_currents(actuation_, generator_, output_.reached), dt);
  output_.currents = drive_.currents();
  output_.status = send(driver_, drive_.turning());
  if (const auto phase = driver_.report().phase) generator_.follow_phase(*phase);
}

std::string CoilController::trouble() const { return trouble_of(driver_, output_.status); }

StopReport CoilController::stop() noexcept {
  drive_.cut();
  output_.currents.setZero();
  output_.acknowledged.setZero();
  StopReport report = driver_.stop();
  report.at = steady_seconds();
  return report;
}

}  // namespace microswarm
