// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <string_view>
#include <utility>
#include <vector>

#include "microswarm/actuation/amplifiers/amplifier_params.hpp"

namespace microswarm::actuation {

/// Limits of a coil and its amplifier.
enum class AmplifierLimit { current, voltage, slew, temperature };
constexpr auto enum_names(AmplifierLimit) {
  return std::array<std::pair<AmplifierLimit, std::string_view>, 4>{
      {{AmplifierLimit::current, "current"},
       {AmplifierLimit::voltage, "voltage"},
       {AmplifierLimit::slew, "slew"},
       {AmplifierLimit::temperature, "temperature"}}};
}

/// Unit of the limited quantity.
Unit limit_unit(AmplifierLimit limit);

/// A limit that a command would exceed: requested and allowed value [A, V, A/s, °C].
struct LimitHit {
  AmplifierLimit limit = AmplifierLimit::current;
  std::size_t coil = 0;
  double asked = 0;
  double allowed = 0;
};

/// Currents within all limits.
struct LimitedCurrents {
  Eigen::VectorXd currents{};    ///< [A]
  double scale = 1;              ///< scale applied to the command, in [0, 1]
  bool keeps_direction = true;   ///< whether the currents are `scale` times the requested ones
  std::vector<LimitHit> hits{};  ///< limits that the unscaled command would exceed
};

/// Currents that turn: constant + cosine cos φ + sine sin φ [A], one of each per coil.
struct TurningCurrents {
  double frequency = 0;  ///< of the phase φ [Hz]
  double max_frequency =
      0;             ///< highest frequency that may follow; limits apply to a turn at it [Hz]
  double phase = 0;  ///< current φ [rad]
  Eigen::VectorXd constant{}, cosine{}, sine{};

  /// The currents at `phase` [A].
  Eigen::VectorXd now() const;
  /// `factor` times these currents.
  TurningCurrents scaled(double factor) const;
};

/// Amplifiers and coils of a system with their current state. All currents of a
/// command are scaled by one factor, so the field keeps its direction.
class Amplifiers {
 public:
  /// Starts at zero current and ambient temperature.
  explicit Amplifiers(std::vector<AmplifierParams> amplifiers);

  const Eigen::VectorXd& currents() const { return currents_; }          ///< [A]
  const Eigen::VectorXd& temperatures() const { return temperatures_; }  ///< [°C]

  /// Sets the temperatures [°C], one per coil.
  void warm(const Eigen::VectorXd& temperatures);

  /// Sets all currents to zero at once, as when the amplifiers are switched off.
  void cut();

  /// The largest fraction of a command that can be held indefinitely.
  LimitedCurrents steady(const Eigen::VectorXd& wanted) const;

  /// Ramps the currents towards `wanted` over `dt` seconds, as far as the limits allow. If no
  /// fraction of the command is reachable in that time, for example when large currents are
  /// reversed, the currents go straight towards the fraction that can be held and `keeps_direction`
  /// is false. The current of a coil that is too hot is reduced, if necessary to zero.
  LimitedCurrents step(const Eigen::VectorXd& wanted, double dt);

  /// Turns the currents for `dt` seconds up to the phase of `wanted`, within the limits of a whole
  /// turn, and changes amplitudes no faster than the coils allow. Returns the scale applied to
  /// `wanted`; all parts have the same one, so the field keeps its direction. Temperatures follow
  /// the currents of each instant.
  double turn(const TurningCurrents& wanted, double dt);
  /// The last turning currents.
  const TurningCurrents& turning() const { return turning_; }

 private:
  double max_turn_scale(const TurningCurrents& wanted, double dt) const;
  double share_of_change(const TurningCurrents& to, double dt) const;

  struct Bounds {
    Eigen::VectorXd lo, hi;  ///< bounds of the reachable currents [A]
  };
  Bounds reachable(double dt, bool mind_heat) const;
  double temperature_after(std::size_t coil, double to, double dt) const;
  std::vector<LimitHit> broken(const Eigen::VectorXd& to, double dt) const;

  std::vector<AmplifierParams> amplifiers_;
  Eigen::VectorXd currents_;
  Eigen::VectorXd temperatures_;
  TurningCurrents turning_;
};

}  // namespace microswarm::actuation
