// SPDX-License-Identifier: Apache-2.0
#include "microswarm/vision/calibration/lens_distortion.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace microswarm::vision {
namespace {

constexpr double max_k1 = 0.5;

class Lens {
 public:
  Lens(int width, int height)
      : middle_{0.5 * (width - 1), 0.5 * (height - 1)}, radius_(norm(middle_ + Vec2{0.5, 0.5})) {}
  double radius() const { return radius_; }
  /// Position of a point without the distortion.
  Vec2 straightened(Vec2 at_px, double k1) const {
    const Vec2 offset = at_px - middle_;
    return at_px + k1 * squared_norm(offset) / (radius_ * radius_) * offset;
  }
  std::vector<ScalePoint> straightened(std::span<const ScalePoint> points, double k1) const {
    std::vector<ScalePoint> all(points.begin(), points.end());
    for (ScalePoint& p : all) p.at_px = straightened(p.at_px, k1);
    return all;
  }

 private:
  Vec2 middle_;
  double radius_;  // half the diagonal [px]
};

/// The least of a function with one minimum in [lo, hi].
template <class F>
double minimum(const F& f, double lo, double hi) {
  const double golden = 0.5 * (std::sqrt(5.0) - 1);
  double a = hi - golden * (hi - lo), b = lo + golden * (hi - lo);
  double fa = f(a), fb = f(b);
  for (int i = 0; i < 60; ++i) {
    if (fa < fb) {
      hi = std::exchange(b, a);
      fb = fa;
      fa = f(a = hi - golden * (hi - lo));
    } else {
      lo = std::exchange(a, b);
      fa = fb;
      fb = f(b = lo + golden * (hi - lo));
    }
  }
  return 0.5 * (lo + hi);
}

}  // namespace

std::optional<LensDistortion> fit_distortion(std::span<const ScalePoint> points, bool y_up,
                                             int width, int height) {
  if (points.size() < 6) return std::nullopt;
  const auto n = static_cast<double>(points.size());
  const Lens lens(width, height);
  const auto squares = [&](double k1) {
    const double rms = fit_scale(lens.straightened(points, k1), y_up).rms;
    return n * rms * rms;
  };
  const double k1 = minimum(squares, -max_k1, max_k1);
  const FittedScale with = fit_scale(lens.straightened(points, k1), y_up);
  const CameraScale without = fit_scale(points, y_up).scale;
  LensDistortion found{.k1 = k1, .shift_px = std::abs(k1) * lens.radius(), .rms = with.rms};
  // The sum of squares grows by `bend` · (k1 - its best)².
  constexpr double step = 0.05;
  const double least = squares(k1);
  const double bend = (0.5 * (squares(k1 - step) + squares(k1 + step)) - least) / (step * step);
  found.deviation_px = lens.radius() * std::sqrt(least / (2 * n - 5) / bend);
  if (!(found.deviation_px < lens.radius()) || std::abs(k1) > 0.99 * max_k1) return std::nullopt;
  for (const Vec2 corner :
       {Vec2{0, 0}, Vec2{width - 1.0, 0}, Vec2{0, height - 1.0}, Vec2{width - 1.0, height - 1.0}}) {
    const Vec2 position = with.scale.to_world(lens.straightened(corner, k1));
    found.error_px =
        std::max(found.error_px, distance(without.to_world(corner), position) / without.um_per_px);
  }
  return found;
}

}  // namespace microswarm::vision
