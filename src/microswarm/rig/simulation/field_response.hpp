// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <deque>

#include "microswarm/actuation/field/field_generator.hpp"
#include "microswarm/core/angles.hpp"
#include "microswarm/rig/params/field_response_params.hpp"

namespace microswarm {

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
