// SPDX-License-Identifier: Apache-2.0
#include "microswarm/actuation/field_generator.hpp"

#include <algorithm>
#include <cmath>

#include "microswarm/actuation/waveform.hpp"
#include "microswarm/core/angles.hpp"

namespace microswarm {

FieldGenerator::FieldGenerator(const FieldGeneratorParams& params, double heading)
    : params_(params), heading_(heading), wanted_heading_(heading) {
  if (params.kind != FieldKind::rolling) frequency_ = params.frequency;
  update_field();
}

void FieldGenerator::command(const Command& command) {
  const double speed = std::max(command.speed, 0.0);
  if (speed > 0) wanted_heading_ = command.heading;
  if (params_.kind == FieldKind::rolling)
    frequency_ = std::min(speed / params_.length_per_turn, params_.frequency);
  else
    wanted_pitch_ = std::min(speed / params_.speed_per_pitch, params_.max_pitch);  // Eq 2 [radar]
}

const Eigen::Vector3d& FieldGenerator::advance(double dt) {
  const double turn = params_.max_turn_rate * dt;
  heading_ = wrap(heading_ + std::clamp(wrap(wanted_heading_ - heading_), -turn, turn));
  const double lift = params_.max_pitch_rate * dt;
  pitch_ += std::clamp(wanted_pitch_ - pitch_, -lift, lift);
  phase_ = std::fmod(phase_ + 2 * pi * frequency_ * dt, 2 * pi);
  update_field();
  return field_;
}

double FieldGenerator::max_rate() const {
  return params_.amplitude *
         (2 * pi * params_.frequency + params_.max_turn_rate + params_.max_pitch_rate);
}

void FieldGenerator::update_field() {
  switch (params_.kind) {
    case FieldKind::rotating:
      field_ = rotating_field(params_.amplitude, pitch_, heading_, phase_);
      return;
    case FieldKind::rolling:
      field_ = rolling_field(params_.amplitude, heading_, phase_);
      return;
    case FieldKind::oscillating:
      field_ = oscillating_field(params_.amplitude, pitch_, heading_, phase_);
      return;
  }
}

}  // namespace microswarm
