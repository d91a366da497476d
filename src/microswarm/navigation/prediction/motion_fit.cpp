// SPDX-License-Identifier: Apache-2.0
#include "microswarm/navigation/prediction/motion_fit.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace microswarm::navigation {
namespace {

/// Size of a buffer; a median of more differences is hardly more accurate.
constexpr std::size_t max_differences = 64;

/// Whether four sightings are evenly spaced, apart from the rounding of frame times.
bool are_even(std::span<const Sighting, 4> s) {
  const double dt = s[1].t - s[0].t;
  return std::abs(s[2].t - s[1].t - dt) + std::abs(s[3].t - s[2].t - dt) < 1e-6 * dt;
}

/// Square of the third difference of four even sightings.
double squared_difference(std::span<const Sighting, 4> s) {
  return squared_norm(s[3].position - s[0].position + 3 * (s[1].position - s[2].position));
}

/// Third difference of four sightings, in standard deviations of one coordinate's noise.
double third_difference(std::span<const Sighting, 4> s) {
  if (are_even(s)) return std::sqrt(squared_difference(s)) / std::sqrt(20.0);
  Vec2 sum;
  double variance = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    double weight = 1;
    for (std::size_t j = 0; j < 4; ++j)
      if (j != i) weight /= s[i].t - s[j].t;
    sum += weight * s[i].position;
    variance += weight * weight;
  }
  return norm(sum) / std::sqrt(variance);
}

constexpr double rayleigh_median = 1.1774100225154747;  // √(2 ln 2)

/// Whether more than half of the third differences are so small that the noise estimate is its
/// lower bound. Computed without square roots.
bool is_noiseless(std::span<const Sighting> sightings, std::size_t count, double min_noise) {
  constexpr double rounding = 1e-9;
  const double most =
      (1 - rounding) * 20 * rayleigh_median * rayleigh_median * min_noise * min_noise;
  std::size_t small = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const auto four = sightings.subspan(i).first<4>();
    small += are_even(four) && squared_difference(four) < most;
  }
  return small > count / 2;
}

double noise_level(std::span<const Sighting> sightings, const MotionFitTuning& tuning) {
  if (sightings.size() < static_cast<std::size_t>(tuning.min_noise_sightings))
    return tuning.initial_noise;
  const std::size_t count = std::min(sightings.size() - 3, max_differences);
  const auto newest = sightings.last(count + 3);
  if (is_noiseless(newest, count, tuning.min_noise)) return tuning.min_noise;
  std::array<double, max_differences> differences{};
  for (std::size_t i = 0; i < count; ++i)
    differences[i] = third_difference(newest.subspan(i).first<4>());
  const auto middle = differences.begin() + static_cast<std::ptrdiff_t>(count / 2);
  std::nth_element(differences.begin(), middle,
                   differences.begin() + static_cast<std::ptrdiff_t>(count));
  return std::max(tuning.min_noise, *middle / rayleigh_median);
}

/// Sums over sightings, relative to the newest.
struct Moments {
  std::array<double, 5> t{};  ///< Σ tᵏ
  std::array<Vec2, 3> p{};    ///< Σ tᵏ · position
  double squares = 0;         ///< Σ |position|²

  void add(double time, Vec2 position) {
    double power = 1;
    for (std::size_t k = 0; k < t.size(); ++k, power *= time) {
      t[k] += power;
      if (k < p.size()) p[k] += power * position;
    }
    squares += squared_norm(position);
  }
};

/// position(t) = c₀ + c₁ t + c₂ t²
struct Curve {
  std::array<Vec2, 3> c{};
  double residual = 0;       ///< Σ of squares
  double rate_variance = 0;  ///< of c₁, for a noise of 1
};

double squared_residual(const Moments& m, const std::array<Vec2, 3>& c) {
  double sum = m.squares;
  for (std::size_t k = 0; k < 3; ++k) sum -= dot(c[k], m.p[k]);
  return std::max(0.0, sum);
}

Curve straight_through(const Moments& m) {
  const double det = m.t[0] * m.t[2] - m.t[1] * m.t[1];
  Curve out;
  out.c[0] = (m.t[2] * m.p[0] - m.t[1] * m.p[1]) / det;
  out.c[1] = (m.t[0] * m.p[1] - m.t[1] * m.p[0]) / det;
  out.residual = squared_residual(m, out.c);
  out.rate_variance = m.t[0] / det;
  return out;
}

/// Solves the normal equations by the cofactors of their symmetric matrix.
Curve curved_through(const Moments& m) {
  const auto& t = m.t;
  const double a = t[2] * t[4] - t[3] * t[3];
  const double b = t[2] * t[3] - t[1] * t[4];
  const double c = t[1] * t[3] - t[2] * t[2];
  const double d = t[0] * t[4] - t[2] * t[2];
  const double e = t[1] * t[2] - t[0] * t[3];
  const double f = t[0] * t[2] - t[1] * t[1];
  const double det = t[0] * a + t[1] * b + t[2] * c;
  Curve out;
  out.c[0] = (a * m.p[0] + b * m.p[1] + c * m.p[2]) / det;
  out.c[1] = (b * m.p[0] + d * m.p[1] + e * m.p[2]) / det;
  out.c[2] = (c * m.p[0] + e * m.p[1] + f * m.p[2]) / det;
  out.residual = squared_residual(m, out.c);
  out.rate_variance = d / det;
  return out;
}

struct Window {
  Curve curve;
  int sightings = 0;
};

/// Longest windows, ending at the newest sighting, that a line and a parabola fit.
struct Windows {
  Window straight, curved;
};

Windows longest(std::span<const Sighting> sightings, double noise, double max_residual) {
  const Sighting newest = sightings.back();
  Moments m;
  Windows out;
  bool is_straight = true;
  bool is_curved = sightings.size() > 3;
  const auto fits = [&](const Curve& curve, std::size_t spare) {
    const double freedom = 2.0 * static_cast<double>(spare);
    return spare == 0 || !(curve.residual > freedom * max_residual * max_residual * noise * noise);
  };
  const auto lengthen = [&](Window& window, const Curve& curve, std::size_t n, std::size_t terms) {
    if (!fits(curve, n - terms)) return false;
    window = {curve, static_cast<int>(n)};
    return true;
  };
  for (std::size_t n = 1; n <= sightings.size() && (is_straight || is_curved); ++n) {
    const Sighting& s = sightings[sightings.size() - n];
    m.add(s.t - newest.t, s.position - newest.position);
    if (is_straight && n >= 2) is_straight = lengthen(out.straight, straight_through(m), n, 2);
    if (is_curved && n >= 3) is_curved = lengthen(out.curved, curved_through(m), n, 3);
  }
  return out;
}

}  // namespace

MotionFit fit_motion(std::span<const Sighting> sightings, int most, const MotionFitTuning& tuning) {
  if (sightings.empty()) return {};
  MotionFit out;
  out.position = sightings.back().position;
  out.noise = noise_level(sightings, tuning);
  out.velocity_error = std::numeric_limits<double>::infinity();
  out.sightings = 1;
  if (sightings.size() < 2) return out;
  const auto newest = sightings.last(std::min(sightings.size(), static_cast<std::size_t>(most)));
  const Windows fit = longest(newest, out.noise, tuning.max_residual);
  const bool is_curved =
      newest.size() > 3 && fit.curved.curve.rate_variance < fit.straight.curve.rate_variance;
  const Window& best = is_curved ? fit.curved : fit.straight;
  out.position += best.curve.c[0];
  out.velocity = best.curve.c[1];
  out.acceleration = 2 * best.curve.c[2];
  out.velocity_error = out.noise * std::sqrt(best.curve.rate_variance);
  out.sightings = best.sightings;
  return out;
}

}  // namespace microswarm::navigation
