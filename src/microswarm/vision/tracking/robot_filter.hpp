// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "microswarm/geometry/vec2.hpp"

namespace microswarm::vision {

/// Standard deviations in the model of RobotFilter, each along one axis.
struct RobotNoise {
  double measurement = 0;   ///< of a measured position [µm]
  double jitter = 0;        ///< of the random displacement between frames [µm]
  double speed_change = 0;  ///< of the velocity change between frames [µm/s]
  double start_speed = 0;   ///< of the velocity of a robot seen once [µm/s]
};

/// Constant-velocity Kalman filter of a robot's position and velocity. The axes are independent and
/// have the same noise, so one 2 × 2 covariance serves both.
class RobotFilter {
 public:
  /// Starts at the first measured position.
  RobotFilter(Vec2 seen, const RobotNoise& noise)
      : place_(seen),
        var_place_(noise.measurement * noise.measurement),
        var_velocity_(noise.start_speed * noise.start_speed) {}

  /// Predicts the state after `dt` seconds.
  void predict(double dt, const RobotNoise& noise) {
    place_ += dt * velocity_;
    var_place_ += dt * (2 * covariance_ + dt * var_velocity_) + noise.jitter * noise.jitter;
    covariance_ += dt * var_velocity_;
    var_velocity_ += noise.speed_change * noise.speed_change;
  }

  /// Updates the state with a measured position.
  void correct(Vec2 seen, const RobotNoise& noise) {
    const double variance = seen_variance(noise);
    if (variance <= 0) {  // no uncertainty
      place_ = seen;
      return;
    }
    const double gain = var_place_ / variance;
    const double velocity_gain = covariance_ / variance;
    const Vec2 surprise = seen - place_;
    place_ += gain * surprise;
    velocity_ += velocity_gain * surprise;
    var_velocity_ -= velocity_gain * covariance_;
    covariance_ -= gain * covariance_;
    var_place_ -= gain * var_place_;
  }

  /// Variance of a measured position about `place()` along one axis [µm²].
  double seen_variance(const RobotNoise& noise) const {
    return var_place_ + noise.measurement * noise.measurement;
  }
  Vec2 place() const { return place_; }
  Vec2 velocity() const { return velocity_; }

 private:
  Vec2 place_;
  Vec2 velocity_;
  double var_place_;
  double covariance_ = 0;
  double var_velocity_;
};

}  // namespace microswarm::vision
