// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "microswarm/core/fields/fields.hpp"
#include "microswarm/core/matching/assignment.hpp"
#include "microswarm/geometry/vec2.hpp"
#include "microswarm/vision/tracking/robot_filter.hpp"

namespace microswarm::vision {

/// Settings of RobotTracker. Unset values are derived from the robots' diameter and the frame time.
struct TrackerParams {
  int memory = 3;
  int min_lifetime = 4;
  double gate = 4;
  std::optional<double> search_range{};
  std::optional<double> measurement{};
  std::optional<double> jitter{};
  std::optional<double> speed_change{};
  std::optional<double> start_speed{};
  std::optional<double> touch{};

  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.memory, plain("memory", 0, 10000, "Frames for which a lost robot is kept."));
    visit(self.min_lifetime,
          plain("min_lifetime", 1, 10000, "Frames a robot must exist to merge or split.")
              .formerly("lasting"));
    visit(self.gate,
          plain("gate", 0.1, 100, "Mahalanobis distance of the gate if no range is given."));
    visit(self.search_range,
          um("search_range", 0, 1e6, "Search radius; none: 5/11 of the diameter, in the gate."));
    visit(self.measurement,
          um("measurement", 1e-9, 1e6, "Measurement noise (sd); none: 1/50 of the diameter."));
    visit(self.jitter,
          um("jitter", 0, 1e6, "Displacement noise per frame (sd); none: diameter / 10."));
    visit(self.speed_change,
          um_per_s("speed_change", 0, 1e9,
                   "Velocity noise per frame (sd); none: diameter / 100 a frame."));
    visit(self.start_speed, um_per_s("start_speed", 0, 1e9,
                                     "Initial velocity (sd); none: from diameter, search range."));
    visit(self.touch, um("touch", 0, 1e6, "Distance of a merge or split; none: 1.2 diameters."));
  }
};

/// Search radius [µm] for robots of `diameter` [µm]: the given one, or the default.
inline double search_range(const TrackerParams& params, double diameter) {
  return params.search_range.value_or(5 * diameter / 11);
}

/// A robot seen in a frame.
struct SeenRobot {
  int id = 0;       ///< numbered from 0 in the order of birth
  Vec2 position{};  ///< filtered [µm]
  Vec2 velocity{};  ///< filtered [µm/s]
};

/// Kind of a track event.
enum class TrackChange { birth, death, merge, split };
constexpr auto enum_names(TrackChange) {
  return std::array<std::pair<TrackChange, std::string_view>, 4>{{{TrackChange::birth, "birth"},
                                                                  {TrackChange::death, "death"},
                                                                  {TrackChange::merge, "merge"},
                                                                  {TrackChange::split, "split"}}};
}

/// A track event. A death is dated to the last frame in which the robot was seen. A merge: `id`
/// vanished where it touched `other`. A split: `id` was born or reappeared where it touched
/// `other`. Merges and splits are reported once they have lasted, dated to the frame in which they
/// occurred. A robot born of a split also has its birth event; one that does not return from a
/// merge also has its death event.
struct TrackEvent {
  int frame = 0;
  TrackChange change = TrackChange::birth;
  int id = 0;
  std::optional<int> other{};
};

/// Tracks robots through the frames of a video. A RobotFilter predicts each robot; positions within
/// the search range, if one is given, or else within its gate are candidates. The most likely
/// assignment of robots to positions is chosen. A robot that is not seen is predicted for some
/// frames. The tracker is deterministic.
class RobotTracker {
 public:
  /// `diameter` [µm] of the robots and `frame_time` [s] between frames, both above 0.
  RobotTracker(const TrackerParams& params, double diameter, double frame_time);

  /// Processes the next frame with the detected positions [µm]. Returns the robot at each position,
  /// in the same order. Valid until the next call. `elapsed` [s] is the time since the frame
  /// before, above 0, where frames are not even; the noise of prediction grows with it.
  const std::vector<SeenRobot>& step(int frame, std::span<const Vec2> seen,
                                     std::optional<double> elapsed = std::nullopt);

  /// Ends the video: all remaining tracks die.
  void finish();

  /// All events so far. Births are reported at once, other events when they are certain.
  const std::vector<TrackEvent>& events() const { return events_; }
  /// Number of robots ever seen.
  int births() const { return next_id_; }

 private:
  /// A disappearance or appearance next to another robot.
  struct Touch {
    int frame;
    int other;
  };
  struct Robot {
    int id;
    int last_frame;
    int missed = 0;
    int run = 1;                      ///< number of consecutive frames in which it was seen
    bool merged = false;              ///< it has merged with another robot
    std::optional<Touch> vanished{};  ///< set if the other robot had been seen for long enough
    std::optional<Touch> appeared{};  ///< likewise; until the robot itself has lasted
    RobotFilter filter;
  };

  void predict(double elapsed);
  void find_candidates(std::span<const Vec2> seen);
  void match(int frame, std::span<const Vec2> seen);
  void miss(Robot& robot, int frame, std::span<const Vec2> seen);
  void meet(Robot& robot, int frame, Vec2 position, std::span<const Vec2> seen);
  void note_split(Robot& robot);
  std::optional<Touch> touched(Vec2 position, int of, int frame, std::span<const Vec2> seen) const;
  void give_birth(int frame, std::span<const Vec2> seen);
  void bury();

  RobotNoise noise_;
  double gate_;
  double search_range_;
  bool is_range_given_;
  double touch_;
  double frame_time_;
  int memory_;
  int lasting_;
  int next_id_ = 0;
  std::optional<int> frame_;  ///< the last frame
  std::vector<Robot> robots_;
  std::vector<int> by_height_;                ///< indices of the detected positions, sorted by y
  std::vector<std::optional<int>> robot_at_;  ///< index of the robot at each detected position
  std::vector<AssignmentEdge> edges_;
  double unseen_cost_ = 0;  ///< that an edge must not exceed to be taken
  Assignment assignment_;
  std::vector<SeenRobot> sightings_;
  std::vector<TrackEvent> events_;
};

}  // namespace microswarm::vision
