// SPDX-License-Identifier: Apache-2.0
#include "microswarm/actuation/amplifiers/amplifiers.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <optional>

#include "microswarm/actuation/amplifiers/coil_heat.hpp"
#include "microswarm/core/maths/angles.hpp"
#include "microswarm/core/maths/infinity.hpp"
#include "microswarm/core/maths/maths.hpp"

namespace microswarm::actuation {
namespace {

constexpr double bound_rounding = 1e-12;
constexpr double h_per_mh = 1e-3;

/// Largest s in [0, 1] for which from + s · way is within the bounds; nothing if there is none.
std::optional<double> farthest(const Eigen::VectorXd& from, const Eigen::VectorXd& change,
                               const Eigen::VectorXd& lo, const Eigen::VectorXd& hi) {
  double least = 0;
  double most = 1;
  for (Eigen::Index i = 0; i < change.size(); ++i) {
    const double slack = bound_rounding * (1 + std::abs(from[i]) + std::abs(change[i]));
    if (lo[i] > hi[i] + slack) return std::nullopt;
    if (change[i] == 0) {
      if (from[i] < lo[i] - slack || from[i] > hi[i] + slack) return std::nullopt;
      continue;
    }
    const double a = (lo[i] - from[i]) / change[i];
    const double b = (hi[i] - from[i]) / change[i];
    least = std::max(least, std::min(a, b) - slack / std::abs(change[i]));
    most = std::min(most, std::max(a, b));
  }
  if (!(least <= most + bound_rounding)) return std::nullopt;
  return std::clamp(most, 0.0, 1.0);
}

/// sin x / x, 1 at 0.
double sinc(double x) {
  constexpr double small = 1e-4;
  return std::abs(x) < small ? 1 - x * x / 6 : maths::sin(x) / x;
}

/// Current of one coil: constant + cosine cos φ + sine sin φ [A].
struct Turning {
  double constant = 0, cosine = 0, sine = 0;

  double amplitude() const { return std::sqrt(cosine * cosine + sine * sine); }
  /// Mean square [A²] over phases from `phase - extent` to `phase`.
  double mean_square(double phase, double extent) const {
    const double middle = phase - extent / 2;
    const auto [s1, c1] = maths::sincos(middle);
    const auto [s2, c2] = maths::sincos(2 * middle);
    const double one = sinc(extent / 2), two = sinc(extent);
    return constant * constant + 2 * constant * one * (cosine * c1 + sine * s1) +
           0.5 * (cosine * cosine * (1 + two * c2) + sine * sine * (1 - two * c2)) +
           cosine * sine * two * s2;
  }
  /// Largest mean square [A²] over any interval of phases of this length.
  double max_mean_square(double extent) const {
    const double A = amplitude();
    return constant * constant + 2 * std::abs(constant) * A * std::abs(sinc(extent / 2)) +
           0.5 * A * A * (1 + std::abs(sinc(extent)));
  }
};

/// Upper bound [K] of a coil's temperature above its mean within a turn, or within `seconds`.
double ripple(const AmplifierParams& d, const Turning& coil, double omega, double seconds) {
  const double A = coil.amplitude(), c = std::abs(coil.constant);
  const double per_square = d.thermal_resistance * hot_resistance(d) / d.thermal_time;
  return per_square * std::min((A * A / 4 + 2 * c * A) / omega, (c + A) * (c + A) * seconds);
}

Turning turning_current(const TurningCurrents& currents, Eigen::Index i) {
  return {currents.constant[i], currents.cosine[i], currents.sine[i]};
}

// Share of the slew and voltage limits available to the turning itself; the rest is for changes.
constexpr double share_of_turn = 0.9;

void narrow(double& lo, double& hi, double least, double most) {
  lo = std::max(lo, least);
  hi = std::min(hi, most);
}

/// Narrows the bounds to currents after a ramp from `I` [A] in `dt` seconds that heat the coil to
/// at most its maximum temperature, and can be ramped down within another such step. The power of
/// the hottest coil allowed is assumed: at least that of the step, and exact at the limit.
void narrow_by_heat(double& lo, double& hi, const AmplifierParams& d, double temperature, double I,
                    double dt) {
  const double per_square = d.thermal_resistance * hot_resistance(d);
  if (per_square <= 0) return;
  // The mean square current that ends at the maximum temperature after `seconds`.
  const auto mean_square_for = [&](double seconds) {
    return mean_square_to_limit(d, temperature, seconds);
  };
  const auto root = [](double square) { return square >= 0 ? std::sqrt(square) : -infinity; };
  // to² and (to² + I to + I²) / 3 in this step
  const double one = mean_square_for(dt);
  const double half = root(3 * one - 0.75 * I * I);
  narrow(lo, hi, -0.5 * I - half, -0.5 * I + half);
  narrow(lo, hi, -root(one), root(one));
  // to² / 3 more in the next step
  const double two = mean_square_for(2 * dt);
  const double half_of_two = 0.25 * root(48 * two - 7 * I * I);
  narrow(lo, hi, -0.25 * I - half_of_two, -0.25 * I + half_of_two);
  narrow(lo, hi, -root(1.5 * two), root(1.5 * two));
}

}  // namespace

Unit limit_unit(AmplifierLimit limit) {
  switch (limit) {
    case AmplifierLimit::current:
      return Unit::a;
    case AmplifierLimit::voltage:
      return Unit::v;
    case AmplifierLimit::slew:
      return Unit::a_per_s;
    case AmplifierLimit::temperature:
      return Unit::degc;
  }
  assert(false);
  return Unit::none;
}

Amplifiers::Amplifiers(std::vector<AmplifierParams> amplifiers)
    : amplifiers_(std::move(amplifiers)),
      currents_(Eigen::VectorXd::Zero(static_cast<Eigen::Index>(amplifiers_.size()))),
      temperatures_(currents_.size()) {
  for (std::size_t i = 0; i < amplifiers_.size(); ++i)
    temperatures_[static_cast<Eigen::Index>(i)] = amplifiers_[i].ambient;
  cut();
}

void Amplifiers::cut() {
  currents_.setZero();
  turning_ = {.constant = currents_, .cosine = currents_, .sine = currents_};
}

Eigen::VectorXd TurningCurrents::now() const {
  const auto [s, c] = maths::sincos(phase);
  return constant + c * cosine + s * sine;
}

TurningCurrents TurningCurrents::scaled(double factor) const {
  TurningCurrents all = *this;
  for (Eigen::VectorXd* part : {&all.constant, &all.cosine, &all.sine}) *part *= factor;
  return all;
}

void Amplifiers::warm(const Eigen::VectorXd& temperatures) {
  assert(temperatures.size() == temperatures_.size());
  temperatures_ = temperatures;
}

LimitedCurrents Amplifiers::steady(const Eigen::VectorXd& wanted) const {
  assert(wanted.size() == currents_.size());
  LimitedCurrents result;
  for (std::size_t i = 0; i < amplifiers_.size(); ++i) {
    const AmplifierParams& d = amplifiers_[i];
    const double I = std::abs(wanted[static_cast<Eigen::Index>(i)]);
    const auto check = [&](AmplifierLimit limit, double asked, double allowed, double most) {
      if (asked <= allowed + bound_rounding * std::abs(allowed)) return;
      result.hits.push_back({limit, i, asked, allowed});
      result.scale = std::min(result.scale, most / I);
    };
    if (d.max_current) check(AmplifierLimit::current, I, *d.max_current, *d.max_current);
    if (d.max_voltage)
      check(AmplifierLimit::voltage, I * hot_resistance(d), *d.max_voltage,
            *d.max_voltage / hot_resistance(d));
    if (d.max_temperature && I > 0)
      check(AmplifierLimit::temperature, steady_temperature(d, I * I), *d.max_temperature,
            warmest_current(d));
  }
  result.currents = result.scale * wanted;
  return result;
}

/// Temperature [°C] after a ramp of the current, or after the final current for the whole time if
/// that is higher. With the ramp alone the current would oscillate about the value that can be
/// held.
double Amplifiers::temperature_after(std::size_t coil, double to, double dt) const {
  const auto i = static_cast<Eigen::Index>(coil);
  const double from = currents_[i];
  const double mean_square = std::max((from * from + from * to + to * to) / 3, to * to);
  return temperature_later(amplifiers_[coil], temperatures_[i], mean_square, dt);
}

Amplifiers::Bounds Amplifiers::reachable(double dt, bool mind_heat) const {
  Bounds bounds{Eigen::VectorXd::Constant(currents_.size(), -infinity),
                Eigen::VectorXd::Constant(currents_.size(), infinity)};
  for (std::size_t k = 0; k < amplifiers_.size(); ++k) {
    const AmplifierParams& d = amplifiers_[k];
    const auto i = static_cast<Eigen::Index>(k);
    double &lo = bounds.lo[i], &hi = bounds.hi[i];
    const double I = currents_[i];
    if (d.max_current) narrow(lo, hi, -*d.max_current, *d.max_current);
    if (d.max_slew) narrow(lo, hi, I - *d.max_slew * dt, I + *d.max_slew * dt);
    if (d.max_voltage) {  // V = R I + L dI/dt, largest at an end of the ramp
      const double x = h_per_mh * d.inductance / dt;
      const double V = *d.max_voltage;
      const double R = hot_resistance(d);
      narrow(lo, hi, (x * I - V) / (R + x), (x * I + V) / (R + x));
      if (x > 0) narrow(lo, hi, I - (V + R * I) / x, I + (V - R * I) / x);
    }
    if (mind_heat && d.max_temperature) narrow_by_heat(lo, hi, d, temperatures_[i], I, dt);
  }
  return bounds;
}

std::vector<LimitHit> Amplifiers::broken(const Eigen::VectorXd& to, double dt) const {
  std::vector<LimitHit> hits;
  for (std::size_t k = 0; k < amplifiers_.size(); ++k) {
    const AmplifierParams& d = amplifiers_[k];
    const auto i = static_cast<Eigen::Index>(k);
    const double rate = (to[i] - currents_[i]) / dt;
    const auto check = [&](AmplifierLimit limit, double asked,
                           const std::optional<double>& allowed) {
      if (allowed && asked > *allowed + bound_rounding * (1 + std::abs(*allowed)))
        hits.push_back({limit, k, asked, *allowed});
    };
    const double kick = h_per_mh * d.inductance * rate;
    check(AmplifierLimit::current, std::abs(to[i]), d.max_current);
    check(AmplifierLimit::voltage,
          std::max(std::abs(hot_resistance(d) * currents_[i] + kick),
                   std::abs(hot_resistance(d) * to[i] + kick)),
          d.max_voltage);
    check(AmplifierLimit::slew, std::abs(rate), d.max_slew);
    check(AmplifierLimit::temperature, temperature_after(k, to[i], dt), d.max_temperature);
  }
  return hits;
}

LimitedCurrents Amplifiers::step(const Eigen::VectorXd& wanted, double dt) {
  assert(wanted.size() == currents_.size() && dt > 0);
  LimitedCurrents result{.hits = broken(wanted, dt)};
  const Eigen::VectorXd none = Eigen::VectorXd::Zero(wanted.size());
  const Bounds bounds = reachable(dt, true);
  if (const auto scale = farthest(none, wanted, bounds.lo, bounds.hi)) {
    result.scale = *scale;
    result.currents = *scale * wanted;
  } else {
    result.keeps_direction = false;
    const LimitedCurrents held = steady(wanted);
    result.scale = held.scale;
    const Eigen::VectorXd change = held.currents - currents_;
    if (const auto share = farthest(currents_, change, bounds.lo, bounds.hi)) {
      result.currents = currents_ + *share * change;
    } else {  // too hot: reduce as fast as possible
      const Bounds any = reachable(dt, false);
      const Eigen::VectorXd down = -currents_;
      result.scale = 0;
      result.currents = currents_ + farthest(currents_, down, any.lo, any.hi).value_or(0) * down;
    }
  }
  for (std::size_t k = 0; k < amplifiers_.size(); ++k) {
    const auto i = static_cast<Eigen::Index>(k);
    temperatures_[i] = temperature_after(k, result.currents[i], dt);
  }
  currents_ = result.currents;
  return result;
}

double Amplifiers::turn(const TurningCurrents& wanted, double dt) {
  assert(wanted.constant.size() == currents_.size() && dt > 0);
  const double most = max_turn_scale(wanted, dt);
  TurningCurrents to = wanted.scaled(most);
  const double share = share_of_change(to, dt);
  const auto toward = [&](const Eigen::VectorXd& from, Eigen::VectorXd& part) {
    part = from + share * (part - from);
  };
  toward(turning_.constant, to.constant);
  toward(turning_.cosine, to.cosine);
  toward(turning_.sine, to.sine);
  const double extent = 2 * pi * to.frequency * dt;
  for (std::size_t k = 0; k < amplifiers_.size(); ++k) {
    const auto i = static_cast<Eigen::Index>(k);
    const double square = std::max(turning_current(turning_, i).mean_square(to.phase, extent),
                                   turning_current(to, i).mean_square(to.phase, extent));
    temperatures_[i] = temperature_later(amplifiers_[k], temperatures_[i], square, dt);
  }
  turning_ = std::move(to);
  currents_ = turning_.now();
  return most;
}

/// Largest scale at which a turn keeps all limits and the coils stay below their maximum
/// temperature for some steps.
double Amplifiers::max_turn_scale(const TurningCurrents& wanted, double dt) const {
  constexpr double steps_ahead = 10;
  const double omega = 2 * pi * std::max(std::abs(wanted.frequency), wanted.max_frequency);
  double most = 1;
  const auto limit = [&](double asked, double allowed) {
    if (asked > allowed) most = std::min(most, allowed / asked);
  };
  for (std::size_t k = 0; k < amplifiers_.size(); ++k) {
    const AmplifierParams& d = amplifiers_[k];
    const Turning coil = turning_current(wanted, static_cast<Eigen::Index>(k));
    const double A = coil.amplitude();
    if (d.max_current) limit(std::abs(coil.constant) + A, *d.max_current);
    if (d.max_slew) limit(omega * A, share_of_turn * *d.max_slew);
    if (d.max_voltage) {
      const double R = hot_resistance(d), X = h_per_mh * d.inductance * omega;
      limit(R * std::abs(coil.constant) + std::sqrt(R * R + X * X) * A,
            share_of_turn * *d.max_voltage);
    }
    if (d.max_temperature && d.thermal_resistance > 0) {
      const double ahead = steps_ahead * dt;
      const double turning = 2 * pi * std::abs(wanted.frequency);
      const double allowed = mean_square_to_limit(d, temperatures_[static_cast<Eigen::Index>(k)],
                                                  ahead, ripple(d, coil, turning, ahead));
      limit(std::sqrt(coil.max_mean_square(turning * ahead)), std::sqrt(std::max(0.0, allowed)));
    }
  }
  return most;
}

/// Share of a change of the turning currents that is possible in `dt` seconds.
double Amplifiers::share_of_change(const TurningCurrents& to, double dt) const {
  const double omega = 2 * pi * std::max(std::abs(to.frequency), to.max_frequency);
  double share = 1;
  for (std::size_t k = 0; k < amplifiers_.size(); ++k) {
    const AmplifierParams& d = amplifiers_[k];
    const auto i = static_cast<Eigen::Index>(k);
    const Turning a = turning_current(turning_, i), b = turning_current(to, i);
    const Turning change{b.constant - a.constant, b.cosine - a.cosine, b.sine - a.sine};
    const double rate = (std::abs(change.constant) + change.amplitude()) / dt;
    const double A = std::max(a.amplitude(), b.amplitude());
    const auto limit = [&](double asked, double taken, double allowed) {
      const double left = std::max(allowed - taken, (1 - share_of_turn) * allowed);
      if (asked > left) share = std::min(share, left / asked);
    };
    if (d.max_slew) limit(rate, omega * A, *d.max_slew);
    if (d.max_voltage) {
      const double R = hot_resistance(d), X = h_per_mh * d.inductance * omega;
      const double constant = std::max(std::abs(a.constant), std::abs(b.constant));
      limit(h_per_mh * d.inductance * rate, R * constant + std::sqrt(R * R + X * X) * A,
            *d.max_voltage);
    }
  }
  return share;
}

}  // namespace microswarm::actuation
