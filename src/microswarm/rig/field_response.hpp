// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <deque>

#include "microswarm/actuation/field_generator.hpp"
#include "microswarm/core/angles.hpp"

namespace microswarm {

/// What a simulated swarm makes of the field around it: the inverse of FieldGenerator, told by the
/// field alone. A field weaker than `least_amplitude` [mT] moves nothing.
struct FieldResponseParams {
  FieldKind kind = FieldKind::rotating;
  double frequency = 16;                     ///< of the field [Hz]
  double speed_per_pitch = 20 / radians(1);  ///< [µm/s] a rad, c of Eq 2 [radar]
  double length_per_turn = 20;               ///< of a rolling field [µm]
  double least_amplitude = 0.5;              ///< [mT]
};

/// Watches the field and tells how it drives the swarm. Rotating fields: the plane in which the
/// field turned during the last turn is pitched towards the heading, speed = c · pitch. Oscillating
/// fields: so is the axis along which it went. Rolling fields: the body rolls with the field.
class FieldResponse {
 public:
  explicit FieldResponse(const FieldResponseParams& params) : params_(params) {}

  /// The field [mT] is this now, `dt` seconds after it was what it was. Where it drives the swarm,
  /// and how fast.
  Command step(const Eigen::Vector3d& field, double dt);

 private:
  /// The field's doing in a short time.
  struct Piece {
    double dt;
    Eigen::Vector3d sum;
  };

  Command rolling(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double dt);
  Command rotating(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double dt);
  Command oscillating(const Eigen::Vector3d& field, double dt);
  Command pitched(const Eigen::Vector3d& raised);
  Eigen::Vector3d over(const Piece& piece, double last);

  FieldResponseParams params_;
  std::deque<Piece> turn_;  // those of the last turn, or of the time in which a body follows
  Eigen::Vector3d before_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d axis_ = Eigen::Vector3d::UnitX();  // along which the field oscillates
  double heading_ = 0;
};

}  // namespace microswarm
