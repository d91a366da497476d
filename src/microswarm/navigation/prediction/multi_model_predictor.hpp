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

namespace microswarm {

/// A body at a later time, against how it was seen.
struct PredictedBody {
  Vec2 centre;             ///< [µm]
  double turn = 0;         ///< since it was seen [rad]
  double growth = 0;       ///< of its outline since it was seen [µm]
  double uncertainty = 0;  ///< how far off this may be [µm]
};

/// Foresees where moving bodies will be, from nothing but where they were seen. Every body has
/// several models of how it may go on (MotionModels). Each forecasts the body a shorter and a
/// longer time ahead. When that time has come, its error is measured; the model with the smallest
/// recent errors is selected. Allocates nothing once it has seen the bodies.
class MultiModelPredictor {
 public:
  explicit MultiModelPredictor(const MultiModelPredictorParams& params = {});

  /// Takes a frame; see ObstacleTracker::see.
  void update(const Observation& observation);
  /// Bodies of the newest frame, in its order.
  std::size_t size() const { return seen_bodies_.size(); }
  /// The body at time t [s], not before the newest frame.
  PredictedBody at(std::size_t body, double t) const;
  /// Which of MotionModels is selected.
  std::size_t model(std::size_t body) const { return histories_[seen_bodies_[body]].selected; }
  const TrackedBody& tracked(std::size_t body) const {
    return histories_[seen_bodies_[body]].motion;
  }

 private:
  static constexpr std::size_t span_count = 2;

  /// What the models once said of a time to come.
  struct Forecast {
    double due = 0;
    std::array<Vec2, MotionModels::count> places;
    std::array<bool, MotionModels::count> holds{};
  };
  /// Past errors, the newer the weightier.
  struct Record {
    double errors = 0;
    double weight = 0;
  };
  /// All that is known of one body.
  struct BodyHistory {
    std::uint32_t obstacle = 0;
    std::uint32_t leaf = 0;
    TrackedBody motion;
    MotionTrail trail;
    MotionModels models;
    std::vector<Vec2> outline;  ///< when its turn was 0, about the centre
    std::array<std::vector<Forecast>, span_count> open;
    std::array<std::array<Record, span_count>, MotionModels::count> records{};
    std::size_t selected = 0;
    double error = 0;  ///< of the selected model over the longest span [µm]
    std::optional<Oscillation> breath;
    double radius_spread = 0;
  };

  void take(const Snapshot& frame);
  std::size_t history_of(std::uint32_t obstacle, std::uint32_t leaf);
  void append(BodyHistory& history, const Body& body, const TrackedBody& motion);
  void update_errors(BodyHistory& history) const;
  void model(BodyHistory& history, const TrackedBody& motion);
  void issue_forecasts(BodyHistory& history) const;
  void select_model(BodyHistory& history, double speed) const;

  MultiModelPredictorParams params_;
  std::array<double, span_count> spans_;  ///< of the forecasts [s]
  ObstacleTracker tracker_;
  OscillationFit oscillations_;
  double now_;
  std::vector<BodyHistory> histories_;
  std::vector<std::size_t> seen_bodies_;  ///< history of every body of the frame
  std::vector<Sighting> sightings_;
  std::vector<Sighting> radii_;
};

}  // namespace microswarm
