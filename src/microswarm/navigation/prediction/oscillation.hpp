// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "microswarm/navigation/prediction/motion_fit.hpp"
#include "microswarm/navigation/prediction/oscillation_tuning.hpp"

namespace microswarm::navigation {

/// Oscillating position: value + rate · sin(ωt) / ω + curve · (1 − cos ωt) / ω², with t [s] since
/// the newest sighting. Harmonic motion on lines, ellipses and circles has this form; for ω → 0 it
/// is constant acceleration.
struct Oscillation {
  double frequency = 0;  ///< ω [rad/s]
  Vec2 value{};          ///< [µm]
  Vec2 rate{};           ///< [µm/s]
  Vec2 curve{};          ///< [µm/s²]

  Vec2 at(double t) const;
};

/// Fits oscillations to sightings by least squares, over windows of three lengths. The frequency is
/// the best of a fixed set, refined by a parabola. The sines for a frame's time are computed once
/// for all bodies in it. Does not allocate after construction.
class OscillationFit {
 public:
  static constexpr std::size_t window_count = 3;
  using Fits = std::array<std::optional<Oscillation>, window_count>;

  explicit OscillationFit(const OscillationTuning& tuning = {});

  /// Lengths of the windows [s], ascending.
  const std::array<double, window_count>& windows() const { return windows_; }
  /// Starts a frame taken at `now` [s], later than the previous one; no sighting may be newer.
  void begin(double now);
  /// Best oscillation through the sightings in each window; the newest sighting is from the current
  /// frame. Nothing if a window has too few sightings, or if a shorter window already holds them
  /// all.
  Fits fit(std::span<const Sighting> sightings);

 private:
  static constexpr std::size_t rungs = 48;  ///< frequencies; the parabola refines them
  struct Row {
    double t = 0;
    std::array<double, rungs> sine;    ///< sin(ωt) / ω
    std::array<double, rungs> cosine;  ///< (1 − cos ωt) / ω²
  };
  /// Matrices of the normal equations, for every frequency.
  struct Matrix {
    int count = 0;  ///< rows
    std::array<double, rungs> s{}, c{}, ss{}, sc{}, cc{};
    void add(const Row& row);
  };
  /// Coefficients of the three terms, and the residual of Σ |position|².
  struct Terms {
    std::array<Vec2, 3> c{};
    double residual = 0;
  };
  struct Sums;

  void fill(Row& row) const;
  const Matrix& matrix(std::size_t window);
  static std::optional<Terms> solve(const Matrix& matrix, const Sums& sums, std::size_t k);
  std::optional<Oscillation> best_fit(std::size_t window, const Sums& sums, Vec2 origin);

  OscillationTuning tuning_;
  std::array<double, window_count> windows_;
  std::size_t max_rows_;  ///< frames in the longest window
  std::array<double, rungs> frequencies_{};
  double now_ = 0;
  std::vector<Row> rows_;          ///< ascending in time
  std::vector<std::size_t> used_;  ///< rows of the body that is fitted, from the newest on
  std::array<Matrix, window_count> newest_{};  ///< of the newest rows
  Matrix others_{};
};

}  // namespace microswarm::navigation
