// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "microswarm/core/fields/fields.hpp"
#include "microswarm/geometry/vec2.hpp"

namespace microswarm {

/// Maximum absolute value of a coordinate [µm].
inline constexpr double max_coordinate = 1e9;
inline constexpr Range coordinates{-max_coordinate, max_coordinate};

/// No motion.
struct Still {
  static constexpr std::string_view type_name = "still";
  Vec2 position{};
  double heading = 0;
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.position, um("position", coordinates, "Position.").needed());
    visit(self.heading, deg("heading", -360, 360, "Orientation."));
  }
};

/// Straight motion at constant velocity; the heading is the velocity's.
struct Straight {
  static constexpr std::string_view type_name = "straight";
  Vec2 start{};
  Vec2 velocity{};
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.start, um("start", coordinates, "Position at t = 0.").needed());
    visit(self.velocity, um_per_s("velocity", -1e5, 1e5, "Velocity.").needed());
  }
};

/// Harmonic motion on a line: centre + amplitude · sin(2π(t / period + phase)). The heading is
/// always that of the amplitude.
struct HarmonicLine {
  static constexpr std::string_view type_name = "harmonic_line";
  Vec2 centre{};
  Vec2 amplitude{};
  double period = 20;
  double phase = 0;
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.centre, um("centre", coordinates, "Centre of the motion.").needed());
    visit(self.amplitude,
          um("amplitude", coordinates, "Distance from the centre to an end.").needed());
    visit(self.period, s("period", 1e-2, 1e6, "Period."));
    visit(self.phase, plain("phase", -1, 1, "Share of the period at t = 0."));
  }
};

/// Harmonic motion on an arc around a pivot: angle = middle + half_angle · sin(2π(t / period +
/// phase)). The heading turns with the arc: a quarter turn left of the radius.
struct HarmonicArc {
  static constexpr std::string_view type_name = "harmonic_arc";
  Vec2 pivot{};
  double radius = 100;
  double middle = 0;
  double half_angle = 0.5;
  double period = 20;
  double phase = 0;
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.pivot, um("pivot", coordinates, "Centre of the arc.").needed());
    visit(self.radius, um("radius", 0, 1e6, "Radius of the arc.").needed());
    visit(self.middle, deg("middle", -360, 360, "Direction of the arc's middle."));
    visit(self.half_angle, deg("half_angle", 0, 180, "Angle from the middle to an end."));
    visit(self.period, s("period", 1e-2, 1e6, "Period."));
    visit(self.phase, plain("phase", -1, 1, "Share of the period at t = 0."));
  }
};

/// Behaviour of a mover after its last waypoint.
enum class AtEnd { stay, back, loop };
constexpr auto enum_names(AtEnd) {
  return std::array<std::pair<AtEnd, std::string_view>, 3>{
      {{AtEnd::stay, "stay"}, {AtEnd::back, "back"}, {AtEnd::loop, "loop"}}};
}

/// Motion from waypoint to waypoint at one speed, starting at t = 0. It keeps the heading of its
/// first leg, so that no corner of a body jumps at the end of a leg.
struct Waypoints {
  static constexpr std::string_view type_name = "waypoints";
  std::vector<Vec2> points{};
  double speed = 20;
  AtEnd at_end = AtEnd::back;
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.points, um("points", coordinates, "Points passed, in order.").needed());
    visit(self.speed, um_per_s("speed", 0, 1e5, "Speed."));
    visit(self.at_end, plain("at_end", "Behaviour at the last point: stay, back or loop."));
  }
};

/// Time-stamped positions, interpolated linearly. Absent before the first and after the last;
/// heading 0.
struct Samples {
  std::vector<double> times{};  ///< [s], ascending
  std::vector<Vec2> points{};   ///< [µm], one per time
};

/// One body of a recorded track file (CSV with columns id, t_s, x_um, y_um). The scenario reader
/// fills the samples; until then the mover is absent.
struct Track {
  static constexpr std::string_view type_name = "track";
  std::string file{};
  std::string id{};
  std::shared_ptr<const Samples> samples{};
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.file, plain("file", "CSV with columns id, t_s, x_um, y_um.").needed());
    visit(self.id, plain("id", "Identifier in the file.").needed());
  }
};

using Motion = std::variant<Still, Straight, HarmonicLine, HarmonicArc, Waypoints, Track>;

/// Pose and velocity of a mover at one moment; `present` is false outside a track's times.
struct Placement {
  bool present = true;
  Pose2 pose{};
  Vec2 velocity{};  ///< [µm/s]
};

/// Placement at time t [s]. Pure: the same t gives the same bits.
Placement placement(const Motion& motion, double t);
/// Upper bound of the speed [µm/s]; infinite for a track that jumps.
double top_speed(const Motion& motion);
/// Upper bound of the turning rate [rad/s].
double top_turning(const Motion& motion);

/// The track of a motion that is read from a file; null for others.
Track* find_track(Motion& motion);
const Track* find_track(const Motion& motion);

}  // namespace microswarm
