// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "microswarm/contracts/observation.hpp"
#include "microswarm/geometry/edge_grid.hpp"
#include "microswarm/navigation/prediction/motion_fit.hpp"
#include "microswarm/navigation/prediction/obstacle_tracker_params.hpp"

namespace microswarm::navigation {

/// Estimated motion of one body at the time of the newest frame.
struct TrackedBody {
  Vec2 centre{};              ///< the disc's, or the centroid of the outline [µm]
  Vec2 velocity{};            ///< of the centre [µm/s]; 0 if seen only once
  Vec2 acceleration{};        ///< of the centre [µm/s²]; 0 while it moves straight
  double velocity_error = 0;  ///< of a coordinate, standard deviation [µm/s]; infinite at first
  double noise = 0;           ///< standard deviation of an observed coordinate of the centre [µm]
  double radius = 0;          ///< of the disc, or to the farthest vertex [µm]
  double radius_rate = 0;     ///< [µm/s]
  double outline_speed = 0;   ///< outward speed of the outline relative to the centre [µm/s]
  int frames = 0;             ///< number of frames used

  /// Position of its centre `dt` seconds later at this velocity.
  Vec2 centre_after(double dt) const { return centre + dt * velocity; }
};

/// Estimates the motion of every obstacle from positions in frames and their times. Frames may be
/// missing, late or irregular. A body is identified by its obstacle's number; the leaves of one
/// obstacle by their order, as they are consecutive in a frame. Does not allocate once it has seen
/// the obstacles.
class ObstacleTracker {
 public:
  explicit ObstacleTracker(const ObstacleTrackerParams& params = {}) : params_(params) {}

  /// Processes a frame. One with the same time as the last is ignored. An older one, or one with
  /// the same time and another number of bodies, resets the tracker. An observation without a world
  /// is ignored. Bodies farther than `range` [µm] from the observed swarm are left out.
  void update(const Observation& observation,
              double range = std::numeric_limits<double>::infinity());
  /// Number of bodies in the newest frame.
  std::size_t size() const { return trail_of_.size(); }
  /// Motion of the body with this index in the newest frame's moving().bodies(). A body left out is
  /// at rest, with infinite velocity error.
  TrackedBody body(std::size_t body) const { return estimate(trails_[trail_of_[body]]); }
  /// Outline speed [µm/s] from the edges inside the disc only, since far parts of a large body may
  /// move. `shape` is that body in the newest frame.
  double outline_speed_within(std::size_t body, const Body& shape, Disc within) const;
  /// Time of the newest frame [s]; -infinity before the first.
  double seen() const { return seen_; }

 private:
  using Key = std::pair<std::uint32_t, std::uint32_t>;  ///< obstacle and leaf
  /// Past polygon relative to its centre; no vertices if there is none yet.
  struct Outline {
    double t = 0;
    Polygon shape;
    EdgeGrid edges;  ///< of the shape if it is the older one and has many
  };
  /// History of one body.
  struct Trail {
    Key key;
    double present = 0;               ///< last time it was in a frame [s]
    std::vector<Sighting> positions;  ///< of the centre, ascending in time; empty if left out
    std::vector<Sighting> radii;      ///< (radius, 0)
    std::array<Outline, 2> past;      ///< of a polygon: older one first
    double outline_speed = 0;
  };

  void find_trails(std::span<const Body> bodies);
  std::vector<Trail>::iterator lower_bound(const Key& key);
  void extend(Trail& trail, const Body& body, Disc within) const;
  void compare_outline(Trail& trail, const Polygon& polygon, Vec2 centre) const;
  static void index(Outline& outline);
  template <class Counts>
  static double outward_distance(const Polygon& polygon, Vec2 centre, const Outline& before,
                                 Counts&& counts);
  TrackedBody estimate(const Trail& trail) const;

  ObstacleTrackerParams params_;
  double seen_ = -std::numeric_limits<double>::infinity();
  std::vector<Trail> trails_;          ///< ascending by key
  std::vector<std::size_t> trail_of_;  ///< by body of the newest frame
};

/// Upper bound of the outward speed [µm/s] of the body's outline relative to its centre.
double outward_speed(const Body& body, const TrackedBody& motion);

}  // namespace microswarm::navigation
