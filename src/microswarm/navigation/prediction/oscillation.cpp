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

}  // namespace

Vec2 Oscillation::at(double t) const {
  const double half = 0.5 * frequency * t;
  if (std::abs(half) < no_rotation) return value + t * rate + (0.5 * t * t) * curve;
  const auto [sine, cosine] = maths::sincos(half);
  return value + (2 * sine * cosine / frequency) * rate +
         (2 * sine * sine / (frequency * frequency)) * curve;
}

/// Right-hand sides of the normal equations, for every frequency.
struct OscillationFit::Sums {
  double squares = 0;
  Vec2 positions;
  std::array<double, rungs> sx{}, sy{}, cx{}, cy{};

  void add(const Row& row, Vec2 position) {
    squares += squared_norm(position);
    positions += position;
    for (std::size_t k = 0; k < rungs; ++k) {
      sx[k] += row.sine[k] * position.x;
      sy[k] += row.sine[k] * position.y;
      cx[k] += row.cosine[k] * position.x;
      cy[k] += row.cosine[k] * position.y;
    }
  }
};

void OscillationFit::Matrix::add(const Row& row) {
  ++count;
  for (std::size_t k = 0; k < rungs; ++k) {
    const double sine = row.sine[k];
    const double cosine = row.cosine[k];
    s[k] += sine;
    c[k] += cosine;
    ss[k] += sine * sine;
    sc[k] += sine * cosine;
    cc[k] += cosine * cosine;
  }
}

/// Solves by the cofactors of the symmetric matrix; nothing if it is singular.
std::optional<OscillationFit::Terms> OscillationFit::solve(const Matrix& m, const Sums& sums,
                                                           std::size_t k) {
  const double n = m.count;
  const double a = m.ss[k] * m.cc[k] - m.sc[k] * m.sc[k];
  const double b = m.c[k] * m.sc[k] - m.s[k] * m.cc[k];
  const double d = m.s[k] * m.sc[k] - m.c[k] * m.ss[k];
  const double e = n * m.cc[k] - m.c[k] * m.c[k];
  const double f = m.s[k] * m.c[k] - n * m.sc[k];
  const double g = n * m.ss[k] - m.s[k] * m.s[k];
  const double determinant = n * a + m.s[k] * b + m.c[k] * d;
  if (!(determinant > 0)) return std::nullopt;
  const Vec2 by_sine{sums.sx[k], sums.sy[k]};
  const Vec2 by_cosine{sums.cx[k], sums.cy[k]};
  Terms out;
  out.c[0] = (a * sums.positions + b * by_sine + d * by_cosine) / determinant;
  out.c[1] = (b * sums.positions + e * by_sine + f * by_cosine) / determinant;
  out.c[2] = (d * sums.positions + f * by_sine + g * by_cosine) / determinant;
  out.residual = sums.squares - dot(out.c[0], sums.positions) - dot(out.c[1], by_sine) -
                 dot(out.c[2], by_cosine);
  return out;
}

OscillationFit::OscillationFit(const OscillationTuning& tuning)
    : tuning_(tuning),
      windows_{tuning.short_window, tuning.medium_window, tuning.long_window},
      max_rows_(static_cast<std::size_t>(std::ceil(tuning.long_window / tuning.frame_spacing)) +
                extra_rows) {
  const double step = maths::log(tuning.max_frequency / tuning.min_frequency) / (rungs - 1);
  for (std::size_t k = 0; k < rungs; ++k)
    frequencies_[k] = tuning.min_frequency * maths::exp(step * static_cast<double>(k));
  rows_.reserve(max_rows_);
  used_.reserve(max_rows_);
}

void OscillationFit::begin(double now) {
  now_ = now;
  if (rows_.size() > 1 && rows_.back().t - rows_[rows_.size() - 2].t < tuning_.frame_spacing)
    rows_.pop_back();
  std::erase_if(rows_, [&](const Row& row) { return row.t < now - windows_.back(); });
  if (rows_.size() == max_rows_) rows_.erase(rows_.begin());
  rows_.emplace_back().t = now;
  for (Row& row : rows_) fill(row);
  for (Matrix& matrix : newest_) matrix.count = 0;
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
  used_.clear();
  std::size_t window = 0;
  std::size_t row = rows_.size();
  for (std::size_t i = sightings.size(); i-- > 0;) {
    const Sighting& seen = sightings[i];
    while (row > 0 && rows_[row - 1].t > seen.t + same_time) --row;
    if (row == 0) break;
    if (rows_[row - 1].t < seen.t - same_time) continue;
    for (; window < window_count && now_ - seen.t > windows_[window]; ++window)
      out[window] = best_fit(window, sums, origin);
    if (window == window_count) return out;
    sums.add(rows_[row - 1], seen.position - origin);
    used_.push_back(row - 1);
  }
  if (window < window_count) out[window] = best_fit(window, sums, origin);
  return out;
}

/// Matrix of the rows that are used. Bodies that are seen in all of the newest frames share it.
const OscillationFit::Matrix& OscillationFit::matrix(std::size_t window) {
  const bool are_newest = used_.back() + used_.size() == rows_.size();
  Matrix& out = are_newest ? newest_[window] : others_;
  if (are_newest && static_cast<std::size_t>(out.count) == used_.size()) return out;
  out = {};
  for (const std::size_t i : used_) out.add(rows_[i]);
  return out;
}

std::optional<Oscillation> OscillationFit::best_fit(std::size_t window, const Sums& sums,
                                                    Vec2 origin) {
  if (used_.size() < static_cast<std::size_t>(tuning_.min_sightings)) return std::nullopt;
  const Matrix& normal = matrix(window);
  std::array<std::optional<Terms>, rungs> terms;
  std::size_t best = rungs;
  for (std::size_t k = 0; k < rungs; ++k) {
    terms[k] = solve(normal, sums, k);
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
