// SPDX-License-Identifier: Apache-2.0
#include "microswarm/report/radar_view.hpp"

#include <fmt/format.h>

#include <array>

#include "microswarm/core/maths/angles.hpp"
#include "microswarm/navigation/radar/radar_circles.hpp"
#include "microswarm/navigation/radar/wait_zone.hpp"

namespace microswarm::report {
namespace {

constexpr Colour detected_colour{0.97, 0.72, 0.66, 0.95};
constexpr Colour velocity{0.0, 0.30, 0.60, 1};
constexpr Colour driven{0.0, 0.38, 0.27, 1};
constexpr Colour deviation{0.35, 0.35, 0.35, 1};

constexpr double dot_px = 4.5;      // radius of a waypoint's dot
constexpr double head_px = 10;      // length of an arrow's head
constexpr double arrow_length = 2;  // at the swarm's maximum speed, in swarm radii
constexpr double min_cost = 0.005;  // α is drawn above this δ

void draw_obstacles(Picture& picture, const Snapshot& world, Disc circle) {
  for (const Body& body : world.moving().bodies())
    picture.bodies({&body, 1}, distance(circle.centre, body) < circle.radius ? detected_colour
                                                                             : colours::obstacle);
}

void draw_plan(Picture& picture, const experiment::Record& record) {
  if (record.plans.empty()) return;
  const Plan& plan = record.plans.front().plan;
  picture.tree(plan.tree, colours::tree);
  picture.line(plan.path, colours::path, 1.5, true);
  for (std::size_t k = 1; k + 1 < plan.path.size(); ++k)
    picture.disc({plan.path[k], dot_px * picture.um_per_px()}, colours::path);
}

void arrow(Picture& picture, Vec2 from, Vec2 offset, Colour colour, double head) {
  if (norm(offset) < head) return;
  const Vec2 tip = from + offset;
  const Vec2 back = (head / norm(offset)) * offset;
  const Vec2 aside = 0.45 * Vec2{-back.y, back.x};
  picture.line(std::array{from, tip}, colour, 2.5);
  picture.line(std::array{tip - back + aside, tip, tip - back - aside}, colour, 2.5);
}

/// Time [s] over which velocity arrows extend.
double arrow_time(const experiment::Scenario& scenario) {
  const SwarmLimits swarm = swarm_limits(scenario.swarm);
  return arrow_length * swarm.radius / swarm.max_speed;
}

/// Draws velocities of the obstacles and the swarm, and the direction v_t from which it deviates by
/// α.
void draw_velocities(Picture& picture, const experiment::Record& record, const World& world,
                     const experiment::Frame& frame,
                     const std::optional<navigation::RadarLook>& look) {
  const double head = head_px * picture.um_per_px();
  const double seconds = arrow_time(record.scene.scenario);
  for (const Obstacle& obstacle : world.obstacles)
    if (const Placement at = placement(obstacle.motion, frame.t); at.present)
      arrow(picture, at.pose.position, seconds * at.velocity, velocity, head);
  const Vec2 p = frame.pose.position;
  if (frame.speed > 0)
    arrow(picture, p, seconds * frame.speed * unit_vector(frame.pose.heading), driven, head);
  if (frame.avoidance_cost <= min_cost || !look) return;
  const Vec2 towards = look->target - p;
  const double reach = 1.2 * look->circles.detection;
  if (norm(towards) <= 0) return;
  const Vec2 end = p + (reach / norm(towards)) * towards;
  picture.line(std::array{p, end}, deviation, 1.5, true);
  picture.text(
      end,
      fmt::format("α = {:.0f}°", degrees(turn_between(frame.pose.heading, heading_along(towards)))),
      deviation);
}

void add_legend(Picture& picture, const navigation::RadarParams& params,
                const experiment::Record& record) {
  picture.legend("swarm", colours::swarm, true);
  picture.legend("travelled path", colours::trail);
  picture.legend("obstacle", colours::obstacle, true);
  picture.legend("detected", detected_colour, true);
  picture.legend("detection circle", colours::radar_detection);
  picture.legend("safety circle", colours::radar_safety);
  picture.legend("prediction circle", colours::radar_prediction);
  const double seconds = arrow_time(record.scene.scenario);
  picture.legend(fmt::format("motion in {:.1f} s: swarm", seconds), driven);
  picture.legend("of obstacles", velocity);
  if (!record.plans.empty()) picture.legend("planned path", colours::path);
  if (!record.plans.empty()) picture.legend("FMT* tree", colours::tree);
  if (!params.wait_zones.empty()) picture.legend("wait zone", colours::wait_zone);
}

}  // namespace

void draw_wait_zones(Picture& picture, const navigation::RadarParams& params, double width_px) {
  for (const navigation::WaitZone& zone : params.wait_zones) {
    std::vector<Vec2> outline = navigation::zone_outline(zone).outer;
    outline.push_back(outline.front());
    picture.line(outline, colours::wait_zone, width_px, true);
  }
}

void draw_radar_circles(Picture& picture, const RadarCircles& circles, Vec2 p) {
  picture.circle({p, circles.detection}, colours::radar_detection, 4.5, false);
  picture.circle({p, circles.safety}, colours::radar_safety, 2, true);
  picture.circle({p, circles.prediction}, colours::radar_prediction, 2, false);
}

RadarCircles radar_circles(const experiment::Record& record, std::size_t number,
                           const std::optional<navigation::RadarLook>& look) {
  if (look) return look->circles;
  return navigation::make_circles(
      std::get<navigation::RadarParams>(record.scene.scenario.navigator),
      record.frames[number].radius);
}

void draw_radar_view(Picture& picture, const experiment::Record& record, const World& world,
                     std::size_t number, const std::optional<navigation::RadarLook>& look) {
  const auto& params = std::get<navigation::RadarParams>(record.scene.scenario.navigator);
  const experiment::Frame& frame = record.frames[number];
  const RadarCircles circles = radar_circles(record, number, look);
  const Vec2 p = frame.pose.position;
  picture.walls(*world.map);
  draw_wait_zones(picture, params, 1.5);
  draw_plan(picture, record);
  draw_obstacles(picture, world.at(frame.t), {p, circles.detection});
  std::vector<Vec2> path;
  for (std::size_t i = 0; i <= number; ++i) path.push_back(record.frames[i].pose.position);
  picture.line(path, colours::trail, 2.5);
  picture.mark(*record.scene.scenario.goal, "goal", colours::goal);
  picture.swarm(frame.pose, frame.radius);
  draw_radar_circles(picture, circles, p);
  draw_velocities(picture, record, world, frame, look);
  add_legend(picture, params, record);
}

}  // namespace microswarm::report
