// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <string_view>
#include <utility>
#include <vector>

#include "microswarm/actuation/field/drive_params.hpp"

namespace microswarm {

/// What may limit a coil.
enum class DriveLimit { current, voltage, slew, temperature };
constexpr auto enum_names(DriveLimit) {
  return std::array<std::pair<DriveLimit, std::string_view>, 4>{
      {{DriveLimit::current, "current"},
       {DriveLimit::voltage, "voltage"},
       {DriveLimit::slew, "slew"},
       {DriveLimit::temperature, "temperature"}}};
}

/// Unit of what it limits.
Unit unit_of(DriveLimit limit);

/// A limit that a command would break: what it asked for and what is allowed [A, V, A/s, °C].
struct LimitHit {
  DriveLimit limit = DriveLimit::current;
  std::size_t coil = 0;
  double asked = 0;
  double allowed = 0;
};

/// Currents that break no limit.
struct DrivenCurrents {
  Eigen::VectorXd currents;     ///< [A]
  double scale = 1;             ///< of the command, in [0, 1]
  bool keeps_direction = true;  ///< the currents are `scale` times those asked for
  std::vector<LimitHit> hits;   ///< what the whole command would break, empty when nothing
};

/// The amplifiers and coils of a system with their present currents and temperatures. Every command
/// is scaled as a whole, all coils alike, so that the field keeps its direction.
class CoilDrive {
 public:
  /// Without current, as warm as the surroundings.
  explicit CoilDrive(std::vector<DriveParams> drives);

  const Eigen::VectorXd& currents() const { return currents_; }          ///< [A]
  const Eigen::VectorXd& temperatures() const { return temperatures_; }  ///< [°C]

  /// All currents to zero at once, as when the amplifiers are switched off.
  void cut() { currents_.setZero(); }

  /// The most of a command that can be held for ever.
  DrivenCurrents steady(const Eigen::VectorXd& wanted) const;

  /// Brings the currents to `wanted` in `dt` seconds along a ramp, as far as the limits allow, and
  /// lets the time pass. Where no share of the command can be reached in that time, as when it
  /// reverses fast currents, it goes straight towards its share that can be held and
  /// `keeps_direction` is false. A coil that is too hot already gets less, at last nothing.
  DrivenCurrents step(const Eigen::VectorXd& wanted, double dt);

 private:
  struct Bounds {
    Eigen::VectorXd lo, hi;  ///< of the currents that may be reached [A]
  };
  Bounds reachable(double dt, bool mind_heat) const;
  double temperature_after(std::size_t coil, double to, double dt) const;
  std::vector<LimitHit> broken(const Eigen::VectorXd& to, double dt) const;

  std::vector<DriveParams> drives_;
  Eigen::VectorXd currents_;
  Eigen::VectorXd temperatures_;
};

}  // namespace microswarm
