// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "microswarm/navigation/prediction/motion_models.hpp"
#include "microswarm/navigation/prediction/motion_trail.hpp"
#include "microswarm/navigation/prediction/multi_model_predictor_params.hpp"
#include "microswarm/navigation/prediction/obstacle_tracker.hpp"
#include "microswarm/navigation/prediction/oscillation.hpp"

namespace microswarm::navigation {

/// Predicted state of a body, relative to its last observation.
struct PredictedBody {
  Vec2 centre{};           ///< [µm]
  double turn = 0;         ///< rotation since then [rad]
  double growth = 0;       ///< growth of its outline since then [µm]
  double uncertainty = 0;  ///< expected position error [µm]
};

/// Predicts moving bodies from their observed positions. Every body has several motion models
/// (MotionModels), each of which forecasts it over a shorter and a longer time. When a forecast is
/// due, its error is measured; the model with the smallest recent errors is selected. Does not
/// allocate once it has seen the bodies.
class MultiModelPredictor {
 public:
  explicit MultiModelPredictor(const MultiModelPredictorParams& params = {});

  /// Processes a frame; see ObstacleTracker::update.
  void update(const Observation& observation);
  /// Number of bodies in the newest frame.
  std::size_t size() const { return seen_bodies_.size(); }
  /// Predicts a body at time `t` [s], not before the newest frame.
  PredictedBody at(std::size_t body, double t) const;
  /// Index of the selected model in MotionModels.
  std::size_t model(std::size_t body) const { return histories_[seen_bodies_[body]].selected; }
  /// Share, 0 to 1, by which the errors of a body's prediction are those of one that turns without
  /// notice; 1 for a new body.
  double surprise(std::size_t body) const;
  const TrackedBody& tracked(std::size_t body) const {
    return histories_[seen_bodies_[body]].motion;
  }

  /// Number of bodies that shrank until they were not seen any more, such as the leaves of a valve,
  /// and are expected back.
  std::size_t hidden() const { return hidden_.size(); }
  /// Standard deviation of an observed coordinate of a hidden body [µm].
  double hidden_noise(std::size_t body) const { return histories_[hidden_[body]].motion.noise; }
  /// A hidden body at time `t` [s]: a disc that returns along the swing on which it left, of radius
  /// 0 before.
  Disc hidden_at(std::size_t body, double t) const;

 private:
  static constexpr std::size_t span_count = 2;

  /// A pending forecast of all models.
  struct Forecast {
    double due = 0;
    std::array<Vec2, MotionModels::count> positions;
    std::array<bool, MotionModels::count> holds{};
  };
  /// Exponentially weighted past errors of a model.
  struct Record {
    double errors = 0;
    double weight = 0;
  };
  /// State of one body.
  struct BodyHistory {
    std::uint32_t obstacle = 0;
    std::uint32_t leaf = 0;
    TrackedBody motion;
    MotionTrail trail;
    MotionModels models;
    std::vector<Vec2> outline;  ///< relative to the centre, at turn 0
    std::array<std::vector<Forecast>, span_count> open;
    std::array<std::array<Record, span_count>, MotionModels::count> records{};
    std::size_t selected = 0;
    double error = 0;  ///< error of the selected model over the longest span [µm]
    std::optional<Oscillation> breath;
    double radius_spread = 0;
  };

  void take(const Snapshot& frame);
  std::size_t find_history(std::uint32_t obstacle, std::uint32_t leaf);
  void append(BodyHistory& history, const Body& body, const TrackedBody& motion);
  void update_errors(BodyHistory& history) const;
  void model(BodyHistory& history, const TrackedBody& motion);
  void issue_forecasts(BodyHistory& history) const;
  void find_hidden();
  bool is_hidden(const BodyHistory& history) const;
  void select_model(BodyHistory& history, double speed) const;

  MultiModelPredictorParams params_;
  std::array<double, span_count> spans_;  ///< prediction times [s]
  ObstacleTracker tracker_;
  OscillationFit oscillations_;
  double now_;
  std::vector<BodyHistory> histories_;
  std::vector<std::size_t> seen_bodies_;  ///< index of the history of each body in the frame
  std::vector<std::size_t> hidden_;       ///< the same for the hidden ones
  std::vector<Sighting> sightings_;
  std::vector<Sighting> radii_;
};

}  // namespace microswarm::navigation
