// SPDX-License-Identifier: Apache-2.0
#include "microswarm/navigation/prediction/oscillation.hpp"

#include <algorithm>
#include <cmath>

#include "microswarm/core/maths/maths.hpp"

namespace microswarm::navigation {
namespace {

constexpr double same_time = 1e-9;     // rounding of times [s]
constexpr double no_rotation = 1e-6;   // half angle below which the quotients' limit is exact
constexpr std::size_t extra_rows = 4;  // for the newest frames, besides those at the spacing

/// Coefficients of the three terms, and the residual of Σ |position|².
struct Terms {
  std::array<Vec2, 3> c{};
  double residual = 0;
};

}  // namespace

Vec2 Oscillation::at(double t) const {
  const double half = 0.5 * frequency * t;
  if (std::abs(half) < no_rotation) return value + t * rate + (0.5 * t * t) * curve;
  const auto [sine, cosine] = maths::sincos(half);
  return value + (2 * sine * cosine / frequency) * rate +
         (2 * sine * sine / (frequency * frequency)) * curve;
}

/// Normal equations for every frequency: matrix and right-hand side.
struct OscillationFit::Sums {
  int count = 0;
  double squares = 0;
  Vec2 positions;
  std::array<double, rungs> s{}, c{}, ss{}, sc{}, cc{};
  std::array<double, rungs> sx{}, sy{}, cx{}, cy{};

  void add(const Row& row, Vec2 position) {
    ++count;
    squares += squared_norm(position);
    positions += position;
    for (std::size_t k = 0; k < rungs; ++k) {
      const double sine = row.sine[k];
      const double cosine = row.cosine[k];
      s[k] += sine;
      c[k] += cosine;
      ss[k] += sine * sine;
      sc[k] += sine * cosine;
      cc[k] += cosine * cosine;
      sx[k] += sine * position.x;
      sy[k] += sine * position.y;
      cx[k] += cosine * position.x;
      cy[k] += cosine * position.y;
    }
  }

  /// Solves by the cofactors of the symmetric matrix; nothing if it is singular.
  std::optional<Terms> solve(std::size_t k) const {
    const double n = count;
    const double a = ss[k] * cc[k] - sc[k] * sc[k];
    const double b = c[k] * sc[k] - s[k] * cc[k];
    const double d = s[k] * sc[k] - c[k] * ss[k];
    const double e = n * cc[k] - c[k] * c[k];
    const double f = s[k] * c[k] - n * sc[k];
    const double g = n * ss[k] - s[k] * s[k];
    const double determinant = n * a + s[k] * b + c[k] * d;
    if (!(determinant > 0)) return std::nullopt;
    const Vec2 by_sine{sx[k], sy[k]};
    const Vec2 by_cosine{cx[k], cy[k]};
    Terms out;
    out.c[0] = (a * positions + b * by_sine + d * by_cosine) / determinant;
    out.c[1] = (b * positions + e * by_sine + f * by_cosine) / determinant;
    out.c[2] = (d * positions + f * by_sine + g * by_cosine) / determinant;
    out.residual =
        squares - dot(out.c[0], positions) - dot(out.c[1], by_sine) - dot(out.c[2], by_cosine);
    return out;
  }
};

OscillationFit::OscillationFit(const OscillationTuning& tuning)
    : tuning_(tuning),
      windows_{tuning.short_window, tuning.medium_window, tuning.long_window},
      max_rows_(static_cast<std::size_t>(std::ceil(tuning.long_window / tuning.frame_spacing)) +
                extra_rows) {
  const double step = maths::log(tuning.max_frequency / tuning.min_frequency) / (rungs - 1);
  for (std::size_t k = 0; k < rungs; ++k)
    frequencies_[k] = tuning.min_frequency * maths::exp(step * static_cast<double>(k));
  rows_.reserve(max_rows_);
}

void OscillationFit::begin(double now) {
  now_ = now;
  if (rows_.size() > 1 && rows_.back().t - rows_[rows_.size() - 2].t < tuning_.frame_spacing)
    rows_.pop_back();
  std::erase_if(rows_, [&](const Row& row) { return row.t < now - windows_.back(); });
  if (rows_.size() == max_rows_) rows_.erase(rows_.begin());
  rows_.emplace_back().t = now;
  for (Row& row : rows_) fill(row);
}

void OscillationFit::fill(Row& row) const {
  for (std::size_t k = 0; k < rungs; ++k) {
    const double w = frequencies_[k];
    const double half = 0.5 * w * (row.t - now_);
    const auto [sine, cosine] = maths::sincos(half);
    row.sine[k] = 2 * sine * cosine / w;
    row.cosine[k] = 2 * sine * sine / (w * w);
  }
}

OscillationFit::Fits OscillationFit::fit(std::span<const Sighting> sightings) {
  Fits out;
  if (sightings.empty() || rows_.empty()) return out;
  const Vec2 origin = sightings.back().position;
  Sums sums;
  std::size_t window = 0;
  std::size_t row = rows_.size();
  for (std::size_t i = sightings.size(); i-- > 0;) {
    const Sighting& seen = sightings[i];
    while (row > 0 && rows_[row - 1].t > seen.t + same_time) --row;
    if (row == 0) break;
    if (rows_[row - 1].t < seen.t - same_time) continue;
    for (; window < window_count && now_ - seen.t > windows_[window]; ++window)
      out[window] = best_fit(sums, origin);
    if (window == window_count) return out;
    sums.add(rows_[row - 1], seen.position - origin);
  }
  if (window < window_count) out[window] = best_fit(sums, origin);
  return out;
}

std::optional<Oscillation> OscillationFit::best_fit(const Sums& sums, Vec2 origin) const {
  if (sums.count < tuning_.min_sightings) return std::nullopt;
  std::array<std::optional<Terms>, rungs> terms;
  std::size_t best = rungs;
  for (std::size_t k = 0; k < rungs; ++k) {
    terms[k] = sums.solve(k);
    if (terms[k] && (best == rungs || terms[k]->residual < terms[best]->residual)) best = k;
  }
  if (best == rungs) return std::nullopt;
  Terms found = *terms[best];
  double frequency = frequencies_[best];
  if (best > 0 && best + 1 < rungs && terms[best - 1] && terms[best + 1]) {
    const Terms& before = *terms[best - 1];
    const Terms& after = *terms[best + 1];
    const double bend = before.residual - 2 * found.residual + after.residual;
    if (bend > 0) {
      const double off = std::clamp(0.5 * (before.residual - after.residual) / bend, -0.5, 0.5);
      for (std::size_t i = 0; i < found.c.size(); ++i)
        found.c[i] += (0.5 * off) * (after.c[i] - before.c[i]) +
                      (0.5 * off * off) * (before.c[i] - 2 * found.c[i] + after.c[i]);
      frequency *= maths::pow(frequencies_[1] / frequencies_[0], off);
    }
  }
  return Oscillation{frequency, origin + found.c[0], found.c[1], found.c[2]};
}

}  // namespace microswarm::navigation
