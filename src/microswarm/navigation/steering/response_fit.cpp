// SPDX-License-Identifier: Apache-2.0
#include "microswarm/navigation/steering/response_fit.hpp"

#include <algorithm>

#include "microswarm/core/maths/maths.hpp"

namespace microswarm::navigation {
namespace {

constexpr double usual_deviation = 0.1;  // of speed factors from 1
constexpr double min_factor = 0.5, max_factor = 1.5;
constexpr std::size_t min_samples = 6;
constexpr double independent = 6;  // misfits among the samples, which follow each other closely

}  // namespace

void ResponseFit::add(double t, Vec2 position, Vec2 commanded) {
  const double spacing = 1.5 * memory_ / static_cast<double>(max_samples);
  if (added_ > 0 && t - samples_[(added_ - 1) % max_samples].t < spacing) return;
  samples_[added_ % max_samples] = {t, position, commanded};
  ++added_;
  if (added_ >= min_samples) fit();
}

void ResponseFit::fit() {
  const std::size_t count = std::min(added_, max_samples);
  const Sample newest = samples_[(added_ - 1) % max_samples];
  std::array<double, max_samples> weights;
  double sum = 0, t = 0;
  Vec2 position, commanded;
  for (std::size_t i = 0; i < count; ++i) {
    const Sample& one = samples_[i];
    weights[i] = maths::exp((one.t - newest.t) / memory_);
    sum += weights[i];
    t += weights[i] * (one.t - newest.t);
    position += weights[i] * (one.position - newest.position);
    commanded += weights[i] * (one.commanded - newest.commanded);
  }
  // Of deviations from the means: time with time, with motion and with commanded motion.
  const auto centred = [&](std::size_t i) {
    const Sample& one = samples_[i];
    return Sample{one.t - newest.t - t / sum, one.position - newest.position - position / sum,
                  one.commanded - newest.commanded - commanded / sum};
  };
  double tt = 0;
  Vec2 tp, tc;
  for (std::size_t i = 0; i < count; ++i) {
    const Sample one = centred(i);
    tt += weights[i] * one.t * one.t;
    tp += (weights[i] * one.t) * one.position;
    tc += (weights[i] * one.t) * one.commanded;
  }
  if (!(tt > 0)) return;
  // What no steady velocity explains; the commanded part of it gives the speed factor.
  double cc = 0, cp = 0, misfit = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const Sample one = centred(i);
    const Vec2 p = one.position - (one.t / tt) * tp;
    const Vec2 c = one.commanded - (one.t / tt) * tc;
    cc += weights[i] * squared_norm(c);
    cp += weights[i] * dot(c, p);
    misfit += weights[i] * squared_norm(p - c);
  }
  const double prior = misfit / (independent * usual_deviation * usual_deviation);
  const double factor = cc + prior > 0 ? (cp + prior) / (cc + prior) : 1;
  response_.speed_factor = std::clamp(factor, min_factor, max_factor);
  response_.flow = (tp - response_.speed_factor * tc) / tt;
  if (!(norm(response_.flow) <= max_flow_)) response_ = {};
}

}  // namespace microswarm::navigation
