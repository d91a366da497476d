// SPDX-License-Identifier: Apache-2.0
#include "microswarm/navigation/prediction/multi_model_predictor.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "microswarm/core/maths/angles.hpp"
#include "microswarm/core/maths/maths.hpp"

namespace microswarm::navigation {
namespace {

/// Time for which a body that has shrunk away is expected back [s].
constexpr double hidden_time = 20;
/// It was larger by this [µm] within this time [s] before.
constexpr double shrinking = 2;
constexpr double shrinking_time = 2;

/// Size of the buffer of pending forecasts.
std::size_t max_open(const MultiModelPredictorTuning& tuning) {
  const double most = std::max(tuning.near_forecast, tuning.far_forecast);
  return static_cast<std::size_t>(most / std::max(tuning.forecast_interval, 1e-2)) + 6;
}

/// Error expected of a model before it has shown any, as a share of the predicted distance.
double model_prior(std::size_t model, const MultiModelPredictorTuning& tuning) {
  if (model == MotionModels::straight) return tuning.straight_prior;
  if (model == MotionModels::curved) return tuning.curved_prior;
  if (model == MotionModels::again) return tuning.recurrence_prior;
  return model < MotionModels::arc ? tuning.swing_prior : tuning.arc_prior;
}

/// Rotation from the outline `then` to `now` about the centre, by corresponding vertices [rad].
double turn_against(std::span<const Vec2> then, std::span<const Vec2> now, Vec2 centre) {
  double sine = 0;
  double cosine = 0;
  for (std::size_t i = 0; i < then.size(); ++i) {
    sine += cross(then[i], now[i] - centre);
    cosine += dot(then[i], now[i] - centre);
  }
  return maths::atan2(sine, cosine);
}

}  // namespace

MultiModelPredictor::MultiModelPredictor(const MultiModelPredictorParams& params)
    : params_(params),
      spans_{params.tuning.near_forecast, params.tuning.far_forecast},
      tracker_(params.tracker),
      oscillations_(params.tuning.oscillation),
      now_(-std::numeric_limits<double>::infinity()) {
  sightings_.reserve(MotionTrail::max_points);
  radii_.reserve(MotionTrail::max_points);
}

void MultiModelPredictor::update(const Observation& observation) {
  tracker_.update(observation);
  if (tracker_.seen() == now_ && tracker_.size() == seen_bodies_.size()) return;
  if (tracker_.seen() < now_) {
    histories_.clear();
    seen_bodies_.clear();
    hidden_.clear();
    oscillations_ = OscillationFit(params_.tuning.oscillation);
  }
  if (tracker_.seen() != now_ || histories_.empty()) oscillations_.begin(tracker_.seen());
  now_ = tracker_.seen();
  if (observation.world) take(*observation.world);
}

void MultiModelPredictor::take(const Snapshot& frame) {
  seen_bodies_.clear();
  const auto bodies = frame.moving().bodies();
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const auto same = [&](const Body& b) { return b.obstacle == bodies[i].obstacle; };
    const auto leaf = std::count_if(bodies.begin(), bodies.begin() + static_cast<long>(i), same);
    const std::size_t at = find_history(bodies[i].obstacle, static_cast<std::uint32_t>(leaf));
    BodyHistory& history = histories_[at];
    const TrackedBody& motion = history.motion = tracker_.body(i);
    append(history, bodies[i], motion);
    update_errors(history);
    model(history, motion);
    select_model(history, norm(motion.velocity));
    issue_forecasts(history);
    seen_bodies_.push_back(at);
  }
  find_hidden();
}

void MultiModelPredictor::find_hidden() {
  hidden_.clear();
  for (std::size_t i = 0; i < histories_.size(); ++i)
    if (is_hidden(histories_[i])) hidden_.push_back(i);
}

bool MultiModelPredictor::is_hidden(const BodyHistory& history) const {
  if (history.trail.empty()) return false;
  const TrailPoint& last = history.trail.back();
  const double gone = now_ - last.t;
  if (gone <= 0 || gone > hidden_time || !history.models.longest_swing()) return false;
  const auto& points = history.trail.points();
  return std::any_of(points.begin(), points.end(), [&](const TrailPoint& p) {
    return p.t >= last.t - shrinking_time && p.radius > last.radius + shrinking;
  });
}

std::size_t MultiModelPredictor::find_history(std::uint32_t obstacle, std::uint32_t leaf) {
  const auto at = std::find_if(histories_.begin(), histories_.end(), [&](const BodyHistory& b) {
    return b.obstacle == obstacle && b.leaf == leaf;
  });
  if (at != histories_.end()) return static_cast<std::size_t>(at - histories_.begin());
  BodyHistory& fresh = histories_.emplace_back();
  fresh.obstacle = obstacle;
  fresh.leaf = leaf;
  fresh.models = MotionModels(params_.tuning.models, params_.tuning.recurrence);
  for (auto& open : fresh.open) open.reserve(max_open(params_.tuning));
  return histories_.size() - 1;
}

void MultiModelPredictor::append(BodyHistory& history, const Body& body,
                                 const TrackedBody& motion) {
  if (!history.trail.empty() && now_ - history.trail.back().t > params_.tuning.max_gap) {
    history.trail.clear();
    for (auto& open : history.open) open.clear();
  }
  const Disc extent = enclosing_disc(body);
  double turn = history.trail.empty() ? 0 : history.trail.back().turn;
  if (const auto* outline = find_outline(body)) {
    if (history.trail.empty() || history.outline.size() != outline->size()) {
      history.outline.assign(outline->begin(), outline->end());
      for (Vec2& v : history.outline) v -= extent.centre;
      turn = 0;
    } else {
      turn += wrap(turn_against(history.outline, *outline, extent.centre) - turn);
    }
  }
  history.trail.add({now_, extent.centre, motion.velocity, extent.radius, turn}, params_.memory);
}

// Compares the forecasts that are due with the frame.
void MultiModelPredictor::update_errors(BodyHistory& history) const {
  const double kept = maths::exp(-0.1 / params_.error_time_constant);
  for (std::size_t k = 0; k < span_count; ++k) {
    auto& open = history.open[k];
    std::size_t done = 0;
    for (; done < open.size() && open[done].due <= now_; ++done) {
      const Forecast& told = open[done];
      const Vec2 was = history.trail.at(told.due).position;
      for (std::size_t m = 0; m < MotionModels::count; ++m) {
        Record& record = history.records[m][k];
        record.errors *= kept;
        record.weight *= kept;
        if (!told.holds[m]) continue;
        record.errors += std::min(params_.tuning.max_error, distance(told.positions[m], was));
        record.weight += 1;
      }
    }
    open.erase(open.begin(), open.begin() + static_cast<std::ptrdiff_t>(done));
  }
}

void MultiModelPredictor::model(BodyHistory& history, const TrackedBody& motion) {
  sightings_.clear();
  radii_.clear();
  double least = std::numeric_limits<double>::infinity();
  double greatest = 0;
  for (const TrailPoint& p : history.trail.points()) {
    if (p.t < now_ - oscillations_.windows().back()) continue;
    sightings_.push_back({p.t, p.position});
    radii_.push_back({p.t, {p.radius, 0}});
    least = std::min(least, p.radius);
    greatest = std::max(greatest, p.radius);
  }
  const Record& straight = history.records[MotionModels::straight].back();
  const bool is_straight =
      straight.weight > params_.tuning.prior_weight &&
      straight.errors < (params_.tuning.error_tolerance + 2 * motion.noise) * straight.weight;
  history.models.fit(history.trail, motion, is_straight ? std::span<const Sighting>{} : sightings_,
                     oscillations_);
  history.breath.reset();
  history.radius_spread = greatest - least;
  if (history.radius_spread < params_.tuning.error_tolerance) return;
  const auto breaths = oscillations_.fit(radii_);
  for (const auto& breath : breaths)
    if (breath &&
        std::abs(breath->at(0).x - history.trail.back().radius) < params_.tuning.error_tolerance)
      history.breath = breath;
}

void MultiModelPredictor::select_model(BodyHistory& history, double speed) const {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t m = 0; m < MotionModels::count; ++m) {
    if (!history.models.holds(m)) continue;
    double sum = 0;
    double last = 0;
    for (std::size_t k = 0; k < span_count; ++k) {
      const Record& record = history.records[m][k];
      const double prior =
          model_prior(m, params_.tuning) * speed * spans_[k] * params_.tuning.prior_weight;
      last = (record.errors + prior) / (record.weight + params_.tuning.prior_weight);
      sum += last / spans_[k];
    }
    if (sum >= least) continue;
    least = sum;
    history.selected = m;
    history.error = last;
  }
}

void MultiModelPredictor::issue_forecasts(BodyHistory& history) const {
  for (std::size_t k = 0; k < span_count; ++k) {
    auto& open = history.open[k];
    const double due = now_ + spans_[k];
    if (open.size() == max_open(params_.tuning)) continue;
    if (!open.empty() && due - open.back().due < params_.tuning.forecast_interval) continue;
    Forecast& told = open.emplace_back();
    told.due = due;
    for (std::size_t m = 0; m < MotionModels::count; ++m) {
      told.holds[m] = history.models.holds(m);
      if (told.holds[m]) told.positions[m] = history.models.position(m, history.trail, spans_[k]);
    }
  }
}

double MultiModelPredictor::surprise(std::size_t body) const {
  const BodyHistory& history = histories_[seen_bodies_[body]];
  const double expected =
      params_.tuning.straight_prior * norm(history.motion.velocity) * spans_.back();
  return expected > 0 ? std::min(1.0, history.error / expected) : 0;
}

// The inner end of a leaf moves by twice the way of its centre.
Disc MultiModelPredictor::hidden_at(std::size_t body, double t) const {
  const BodyHistory& history = histories_[hidden_[body]];
  const TrailPoint& last = history.trail.back();
  const Vec2 centre =
      history.models.position(*history.models.longest_swing(), history.trail, t - last.t);
  const double back = -dot(centre - last.position, history.motion.velocity);
  if (back <= 0) return {last.position, 0};
  return {centre, last.radius + distance(centre, last.position)};
}

PredictedBody MultiModelPredictor::at(std::size_t body, double t) const {
  const BodyHistory& history = histories_[seen_bodies_[body]];
  const TrackedBody& motion = history.motion;
  const double s = t - now_;
  PredictedBody out;
  out.centre = history.models.position(history.selected, history.trail, s);
  out.turn = history.models.turn(history.selected, history.trail, s);
  const double unseen =
      params_.tuning.growth_time * std::abs(motion.radius_rate) + history.radius_spread;
  const double growth = history.breath
                            ? history.breath->at(s).x - history.breath->at(0).x
                            : motion.radius_rate * std::min(s, params_.tuning.growth_time);
  out.growth = std::clamp(growth, -unseen, unseen);
  out.uncertainty =
      std::min(params_.max_uncertainty, params_.uncertainty * history.error * s / spans_.back());
  return out;
}

}  // namespace microswarm::navigation
