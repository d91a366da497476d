// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "microswarm/navigation/prediction/foresight_params.hpp"
#include "microswarm/navigation/prediction/motion_models.hpp"
#include "microswarm/navigation/prediction/motion_trail.hpp"
#include "microswarm/navigation/prediction/obstacle_tracker.hpp"
#include "microswarm/navigation/prediction/oscillation.hpp"

namespace microswarm {

/// A body at a later time, against how it was seen.
struct BodyAhead {
  Vec2 centre;        ///< [µm]
  double turn = 0;    ///< since it was seen [rad]
  double growth = 0;  ///< of its outline since it was seen [µm]
  double doubt = 0;   ///< how far off this may be [µm]
};

/// Foresees where moving bodies will be, from nothing but where they were seen. Every body has
/// several models of how it may go on (MotionModels). Each is asked at every frame where the body
/// will be half a second and one and a half later, and when that time has come it is seen how wrong
/// it was: the model that was least wrong of late is believed. Allocates nothing once it has seen
/// the bodies.
class Foresight {
 public:
  explicit Foresight(const ForesightParams& params = {});

  /// Takes a frame; see ObstacleTracker::see.
  void see(const Observation& observation);
  /// Bodies of the newest frame, in its order.
  std::size_t size() const { return seen_bodies_.size(); }
  /// The body at time t [s], not before the newest frame.
  BodyAhead at(std::size_t body, double t) const;
  /// Which of MotionModels is believed.
  std::size_t model(std::size_t body) const { return books_[seen_bodies_[body]].believed; }
  const TrackedBody& tracked(std::size_t body) const { return books_[seen_bodies_[body]].motion; }

 private:
  static constexpr std::array<double, 2> spans{0.5, 1.5};  ///< of the forecasts that are proved [s]

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
  struct Book {
    std::uint32_t obstacle = 0;
    std::uint32_t leaf = 0;
    TrackedBody motion;
    MotionTrail trail;
    MotionModels models;
    std::vector<Vec2> outline;  ///< when its turn was 0, about the centre
    std::array<std::vector<Forecast>, spans.size()> open;
    std::array<std::array<Record, spans.size()>, MotionModels::count> records{};
    std::size_t believed = 0;
    double error = 0;  ///< of the believed model over the longest span [µm]
    std::optional<Oscillation> breath;
    double radius_spread = 0;
  };

  void take(const Snapshot& frame);
  std::size_t book_of(std::uint32_t obstacle, std::uint32_t leaf);
  void note(Book& book, const Body& body, const TrackedBody& motion);
  void prove(Book& book) const;
  void model(Book& book, const TrackedBody& motion);
  void forecast(Book& book) const;
  void believe(Book& book, double speed) const;

  ForesightParams params_;
  ObstacleTracker tracker_;
  OscillationFit oscillations_;
  double now_;
  std::vector<Book> books_;
  std::vector<std::size_t> seen_bodies_;  ///< book of every body of the frame
  std::vector<Sighting> sightings_;
  std::vector<Sighting> radii_;
};

}  // namespace microswarm
