// SPDX-License-Identifier: Apache-2.0
#include "microswarm/actuation/drivers/coil_drive.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <optional>

#include "microswarm/core/maths/infinity.hpp"
#include "microswarm/core/maths/maths.hpp"

namespace microswarm {
namespace {

constexpr double bound_rounding = 1e-12;
constexpr double h_per_mh = 1e-3;

/// The largest s in [0, 1] for which from + s · way is within the bounds; empty if there is none.
std::optional<double> farthest(const Eigen::VectorXd& from, const Eigen::VectorXd& way,
                               const Eigen::VectorXd& lo, const Eigen::VectorXd& hi) {
  double least = 0;
  double most = 1;
  for (Eigen::Index i = 0; i < way.size(); ++i) {
    const double slack = bound_rounding * (1 + std::abs(from[i]) + std::abs(way[i]));
    if (way[i] == 0) {
      if (from[i] < lo[i] - slack || from[i] > hi[i] + slack) return std::nullopt;
      continue;
    }
    const double a = (lo[i] - from[i]) / way[i];
    const double b = (hi[i] - from[i]) / way[i];
    least = std::max(least, std::min(a, b) - slack / std::abs(way[i]));
    most = std::min(most, std::max(a, b));
  }
  if (!(least <= most + bound_rounding)) return std::nullopt;
  return std::clamp(most, 0.0, 1.0);
}

double steady_temperature(const DriveParams& d, double current) {
  return d.ambient + d.thermal_resistance * d.resistance * current * current;
}

/// The current at which the final temperature is the maximum temperature.
double warmest_current(const DriveParams& d) {
  const double warmer = std::max(0.0, *d.max_temperature - d.ambient);
  const double per_square = d.thermal_resistance * d.resistance;
  return per_square > 0 ? std::sqrt(warmer / per_square) : infinity;
}

void narrow(double& lo, double& hi, double least, double most) {
  lo = std::max(lo, least);
  hi = std::min(hi, most);
}

}  // namespace

Unit unit_of(DriveLimit limit) {
  switch (limit) {
    case DriveLimit::current:
      return Unit::a;
    case DriveLimit::voltage:
      return Unit::v;
    case DriveLimit::slew:
      return Unit::a_per_s;
    case DriveLimit::temperature:
      return Unit::degc;
  }
  assert(false);
  return Unit::none;
}

CoilDrive::CoilDrive(std::vector<DriveParams> drives)
    : drives_(std::move(drives)),
      currents_(Eigen::VectorXd::Zero(static_cast<Eigen::Index>(drives_.size()))),
      temperatures_(currents_.size()) {
  for (std::size_t i = 0; i < drives_.size(); ++i)
    temperatures_[static_cast<Eigen::Index>(i)] = drives_[i].ambient;
}

DrivenCurrents CoilDrive::steady(const Eigen::VectorXd& wanted) const {
  assert(wanted.size() == currents_.size());
  DrivenCurrents result;
  for (std::size_t i = 0; i < drives_.size(); ++i) {
    const DriveParams& d = drives_[i];
    const double I = std::abs(wanted[static_cast<Eigen::Index>(i)]);
    const auto check = [&](DriveLimit limit, double asked, double allowed, double most) {
      if (asked <= allowed + bound_rounding * std::abs(allowed)) return;
      result.hits.push_back({limit, i, asked, allowed});
      result.scale = std::min(result.scale, most / I);
    };
    if (d.max_current) check(DriveLimit::current, I, *d.max_current, *d.max_current);
    if (d.max_voltage)
      check(DriveLimit::voltage, I * d.resistance, *d.max_voltage, *d.max_voltage / d.resistance);
    if (d.max_temperature && I > 0)
      check(DriveLimit::temperature, steady_temperature(d, I), *d.max_temperature,
            warmest_current(d));
  }
  result.currents = result.scale * wanted;
  return result;
}

/// Temperature [°C] after a ramp of the current, or after the final current for the whole time,
/// whichever is higher: exact solution of the thermal RC for the mean power. With the ramp alone
/// the current would oscillate about the value that can be held.
double CoilDrive::temperature_after(std::size_t coil, double to, double dt) const {
  const DriveParams& d = drives_[coil];
  const auto i = static_cast<Eigen::Index>(coil);
  const double from = currents_[i];
  const double mean_square = std::max((from * from + from * to + to * to) / 3, to * to);
  const double end = d.ambient + d.thermal_resistance * d.resistance * mean_square;
  return end + (temperatures_[i] - end) * maths::exp(-dt / d.thermal_time);
}

CoilDrive::Bounds CoilDrive::reachable(double dt, bool mind_heat) const {
  Bounds bounds{Eigen::VectorXd::Constant(currents_.size(), -infinity),
                Eigen::VectorXd::Constant(currents_.size(), infinity)};
  for (std::size_t k = 0; k < drives_.size(); ++k) {
    const DriveParams& d = drives_[k];
    const auto i = static_cast<Eigen::Index>(k);
    double &lo = bounds.lo[i], &hi = bounds.hi[i];
    const double I = currents_[i];
    if (d.max_current) narrow(lo, hi, -*d.max_current, *d.max_current);
    if (d.max_slew) narrow(lo, hi, I - *d.max_slew * dt, I + *d.max_slew * dt);
    if (d.max_voltage) {  // V = R I + L dI/dt, largest at an end of the ramp
      const double x = h_per_mh * d.inductance / dt;
      const double V = *d.max_voltage;
      narrow(lo, hi, (x * I - V) / (d.resistance + x), (x * I + V) / (d.resistance + x));
      if (x > 0) narrow(lo, hi, I - (V + d.resistance * I) / x, I + (V - d.resistance * I) / x);
    }
    const double per_square = d.thermal_resistance * d.resistance;
    if (mind_heat && d.max_temperature && per_square > 0) {
      // to² and (to² + I to + I²) / 3 ≤ the mean square that ends at the maximum temperature
      const double keeps = maths::exp(-dt / d.thermal_time);
      const double end = (*d.max_temperature - temperatures_[i] * keeps) / (1 - keeps);
      const double mean_square = (end - d.ambient) / per_square;
      const double root = 3 * mean_square - 0.75 * I * I;
      const double half = root >= 0 ? std::sqrt(root) : -infinity;
      narrow(lo, hi, -0.5 * I - half, -0.5 * I + half);
      const double held = mean_square >= 0 ? std::sqrt(mean_square) : -infinity;
      narrow(lo, hi, -held, held);
    }
  }
  return bounds;
}

std::vector<LimitHit> CoilDrive::broken(const Eigen::VectorXd& to, double dt) const {
  std::vector<LimitHit> hits;
  for (std::size_t k = 0; k < drives_.size(); ++k) {
    const DriveParams& d = drives_[k];
    const auto i = static_cast<Eigen::Index>(k);
    const double rate = (to[i] - currents_[i]) / dt;
    const auto check = [&](DriveLimit limit, double asked, const std::optional<double>& allowed) {
      if (allowed && asked > *allowed + bound_rounding * (1 + std::abs(*allowed)))
        hits.push_back({limit, k, asked, *allowed});
    };
    const double kick = h_per_mh * d.inductance * rate;
    check(DriveLimit::current, std::abs(to[i]), d.max_current);
    check(DriveLimit::voltage,
          std::max(std::abs(d.resistance * currents_[i] + kick),
                   std::abs(d.resistance * to[i] + kick)),
          d.max_voltage);
    check(DriveLimit::slew, std::abs(rate), d.max_slew);
    check(DriveLimit::temperature, temperature_after(k, to[i], dt), d.max_temperature);
  }
  return hits;
}

DrivenCurrents CoilDrive::step(const Eigen::VectorXd& wanted, double dt) {
  assert(wanted.size() == currents_.size() && dt > 0);
  DrivenCurrents result{.hits = broken(wanted, dt)};
  const Eigen::VectorXd none = Eigen::VectorXd::Zero(wanted.size());
  const Bounds bounds = reachable(dt, true);
  if (const auto scale = farthest(none, wanted, bounds.lo, bounds.hi)) {
    result.scale = *scale;
    result.currents = *scale * wanted;
  } else {
    result.keeps_direction = false;
    const DrivenCurrents held = steady(wanted);
    result.scale = held.scale;
    const Eigen::VectorXd way = held.currents - currents_;
    if (const auto share = farthest(currents_, way, bounds.lo, bounds.hi)) {
      result.currents = currents_ + *share * way;
    } else {  // too hot: reduce as fast as possible
      const Bounds any = reachable(dt, false);
      const Eigen::VectorXd down = -currents_;
      result.scale = 0;
      result.currents = currents_ + farthest(currents_, down, any.lo, any.hi).value_or(0) * down;
    }
  }
  for (std::size_t k = 0; k < drives_.size(); ++k) {
    const auto i = static_cast<Eigen::Index>(k);
    temperatures_[i] = temperature_after(k, result.currents[i], dt);
  }
  currents_ = result.currents;
  return result;
}

}  // namespace microswarm
