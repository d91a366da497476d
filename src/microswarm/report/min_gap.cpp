// SPDX-License-Identifier: Apache-2.0
#include "microswarm/report/min_gap.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "microswarm/core/fields/overloaded.hpp"
#include "microswarm/experiment/session/playback.hpp"
#include "microswarm/navigation/radar/radar_circles.hpp"
#include "microswarm/navigation/radar/safety_radius.hpp"
#include "microswarm/report/decision_marks.hpp"
#include "microswarm/report/radar_view.hpp"

namespace microswarm::report {
namespace {

constexpr Colour then_there{0.35, 0.35, 0.35, 1};

/// The frame with the minimum gap to an obstacle, or to a wall without obstacles.
const experiment::Frame& tightest(const experiment::Record& record) {
  const auto gap = [](const experiment::Frame& f) {
    const bool among = std::isfinite(f.obstacle_clearance);
    return (among ? f.obstacle_clearance : f.wall_clearance) - f.radius;
  };
  return *std::min_element(record.frames.begin(), record.frames.end(),
                           [&](const experiment::Frame& a, const experiment::Frame& b) {
                             const bool a_among = std::isfinite(a.obstacle_clearance);
                             const bool b_among = std::isfinite(b.obstacle_clearance);
                             return a_among != b_among ? a_among : gap(a) < gap(b);
                           });
}

void draw_outline(Picture& picture, const Body& body) {
  std::visit(Overloaded{[&](const Disc& disc) { picture.circle(disc, then_there, 2, false); },
                        [&](const Polygon& polygon) {
                          std::vector<Vec2> outline = polygon.outer;
                          outline.push_back(outline.front());
                          picture.line(outline, then_there, 2, false);
                        }},
             body.shape);
}

void draw_circles(Picture& picture, const experiment::Frame& frame,
                  const navigation::RadarParams& params, const Diagnostics& kept) {
  RadarCircles circles = navigation::make_circles(params, frame.radius);
  circles.safety =
      navigation::SafetyRadius(params.safety_radius)
          .radius(circles.safety, circles.prediction, frame.obstacle_clearance - frame.radius);
  if (const auto* scan = std::get_if<RadarDiagnostics>(&kept)) circles = scan->circles;
  draw_radar_circles(picture, circles, frame.pose.position);
  picture.legend(fmt::format("circles at {:.1f} s, the least gap: detection", frame.t),
                 colours::radar_detection);
  picture.legend("safety", colours::radar_safety);
  picture.legend("prediction", colours::radar_prediction);
}

void draw_places(Picture& picture, const navigation::RadarParams& params) {
  draw_wait_zones(picture, params, 2);
  for (std::size_t i = 0; i < params.waypoints.size(); ++i)
    picture.mark(params.waypoints[i], fmt::format("waypoint {}", i + 1), colours::wait_zone);
  if (!params.wait_zones.empty()) picture.legend("wait zones", colours::wait_zone);
}

}  // namespace

void draw_min_gap(Picture& picture, const experiment::Record& record, const World& world) {
  if (record.frames.empty()) return;
  const auto* radar = std::get_if<navigation::RadarParams>(&record.scene.scenario.navigator);
  const experiment::Frame& frame = tightest(record);
  const Diagnostics kept = decision_at(record, frame.t);
  if (!radar && std::holds_alternative<std::monostate>(kept)) return;
  if (radar) draw_places(picture, *radar);
  const Snapshot then = world.at(frame.t);
  for (const Body& body : then.moving().bodies()) draw_outline(picture, body);
  Colour body = colours::swarm;
  body.alpha = 0.5;
  picture.swarm(frame.pose, frame.radius, body);
  if (radar)
    draw_circles(picture, frame, *radar, kept);
  else
    picture.legend(fmt::format("swarm at {:.1f} s, the least gap", frame.t), body, true);
  draw_decision(picture, kept, experiment::scenario_at(record, frame.t), frame.pose.position);
  if (!then.moving().bodies().empty()) picture.legend("obstacles then", then_there);
}

}  // namespace microswarm::report
