// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "microswarm/contracts/observation.hpp"
#include "microswarm/navigation/prediction/motion_fit.hpp"
#include "microswarm/navigation/prediction/obstacle_tracker_params.hpp"

namespace microswarm {

/// How one body moves, as told from where it was seen; at the time of the newest frame.
struct TrackedBody {
  Vec2 centre;                ///< the disc's, or the centroid of the outline [µm]
  Vec2 velocity;              ///< of the centre [µm/s]; 0 when seen only once
  Vec2 acceleration;          ///< of the centre [µm/s²]; 0 while it goes straight
  double velocity_error = 0;  ///< of a coordinate, standard deviation [µm/s]; infinite at first
  double noise = 0;           ///< with which the centre is seen, of a coordinate [µm]
  double radius = 0;          ///< of the disc, or to the farthest vertex [µm]
  double radius_rate = 0;     ///< [µm/s]
  double outline_speed = 0;   ///< the outline comes outwards so fast besides the centre [µm/s]
  int frames = 0;             ///< on which this stands

  /// Where its centre will be `dt` seconds later at this velocity.
  Vec2 centre_after(double dt) const { return centre + dt * velocity; }
};

/// Tells every obstacle's motion from what was seen of it: places in frames and their times. Frames
/// may be missed, late or uneven. A body is known again by its obstacle's number, the leaves of one
/// obstacle by their order, which follow each other in a frame. Allocates nothing once it has seen
/// the obstacles.
class ObstacleTracker {
 public:
  explicit ObstacleTracker(const ObstacleTrackerParams& params = {}) : params_(params) {}

  /// Takes a frame. One that is as new as the last is not taken again; one that is older, or as
  /// new with another number of bodies, begins anew. An observation without a world is left out.
  /// Bodies all of which are farther than `range` [µm] from the swarm that is seen are left out.
  void update(const Observation& observation,
              double range = std::numeric_limits<double>::infinity());
  /// Of the newest frame.
  std::size_t size() const { return trail_of_.size(); }
  /// How the body at this place in the newest frame's moving().bodies() moves; what was left out
  /// rests, with an infinite velocity error.
  TrackedBody body(std::size_t body) const { return estimate(trails_[trail_of_[body]]); }
  /// Its outline speed, told from those edges alone that come into the disc [µm/s]: parts of a
  /// large body may move that are far away. `shape` is that body in the newest frame.
  double outline_speed_within(std::size_t body, const Body& shape, Disc within) const;
  /// When the newest frame was taken [s]; -infinity before the first.
  double seen() const { return seen_; }

 private:
  using Key = std::pair<std::uint32_t, std::uint32_t>;  ///< obstacle and leaf
  /// A polygon about its centre, as it once was; without vertices: never yet.
  struct Outline {
    double t = 0;
    Polygon shape;
  };
  /// What is remembered of one body.
  struct Trail {
    Key key;
    double present = 0;            ///< when it was in a frame [s]
    std::vector<Sighting> places;  ///< of the centre, ascending in time; none when left out
    std::vector<Sighting> radii;   ///< (radius, 0)
    std::array<Outline, 2> past;   ///< of a polygon: the older first
    double outline_speed = 0;
  };

  void find_trails(std::span<const Body> bodies);
  std::vector<Trail>::iterator lower_bound(const Key& key);
  void extend(Trail& trail, const Body& body, Disc within) const;
  void compare_outline(Trail& trail, const Polygon& polygon, Vec2 centre) const;
  TrackedBody estimate(const Trail& trail) const;

  ObstacleTrackerParams params_;
  double seen_ = -std::numeric_limits<double>::infinity();
  std::vector<Trail> trails_;          ///< ascending by key
  std::vector<std::size_t> trail_of_;  ///< by body of the newest frame
};

/// How fast [µm/s] the body's outline comes outwards besides the motion of its centre, at most.
double outward_speed(const Body& body, const TrackedBody& motion);

}  // namespace microswarm
