// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <deque>

#include "microswarm/actuation/field/field_generator.hpp"
#include "microswarm/core/maths/angles.hpp"
#include "microswarm/rig/params/field_response_params.hpp"

namespace microswarm::rig {

/// Estimates the motion that a field drives. Rotating fields: the plane of rotation over the last
/// turn is pitched towards the heading, speed = c · pitch. Oscillating fields: the same with the
/// axis of oscillation. Rolling fields: the body rolls with the field. Above the step-out frequency
/// f₀ a body lags and slips: of f turns it follows f − √(f² − f₀²).
class FieldResponse {
 public:
  explicit FieldResponse(const FieldResponseParams& params) : params_(params) {}

  /// Advances `dt` seconds to the current field [mT]. Returns the driven heading and speed.
  Command step(const Eigen::Vector3d& field, double dt);

 private:
  /// Contribution of a short interval.
  struct Piece {
    double dt;
    Eigen::Vector3d sum;
  };

  Command driven(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double dt);
  double followed_share(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double dt);
  Command delayed(const Command& command, double dt);
  Command rolling(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double dt);
  Command rotating(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double dt);
  Command oscillating(const Eigen::Vector3d& field, double dt);
  Command pitched(const Eigen::Vector3d& raised);
  Eigen::Vector3d over(const Piece& piece, double last);

  FieldResponseParams params_;
  std::deque<Piece> turn_;  // pieces of the last turn, or of the response time of a rolling body
  Eigen::Vector3d before_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d axis_ = Eigen::Vector3d::UnitX();  // axis of oscillation
  double heading_ = 0;
  double turn_rate_ = 0;  // of the field, averaged [rad/s]
  /// A command and the time at which it is executed.
  struct Later {
    double t;
    Command command;
  };
  std::deque<Later> later_;
  double t_ = 0;  // [s]
};

}  // namespace microswarm::rig
