// SPDX-License-Identifier: Apache-2.0
#include "radar_picture.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "microswarm/navigation/radar_circles.hpp"
#include "microswarm/navigation/safety_radius.hpp"
#include "microswarm/report/picture.hpp"

namespace microswarm::cli {
namespace {

constexpr Colour detection{0.55, 0.35, 0.15, 1};
constexpr Colour safety{0.90, 0.60, 0.0, 1};
constexpr Colour prediction{0.80, 0.15, 0.15, 1};
constexpr Colour detected{0.95, 0.62, 0.55, 0.9};

void draw_circles(Picture& picture, const RadarParams& params, const Frame& frame) {
  RadarCircles circles = circles_of(params, frame.radius);
  if (params.safety_radius.adaptive)
    circles.safety =
        SafetyRadius(params.safety_radius)
            .radius(circles.safety, circles.prediction, frame.obstacle_clearance - frame.radius);
  const Vec2 p = frame.pose.position;
  picture.circle({p, circles.detection}, detection, 2.5, false);
  picture.circle({p, circles.safety}, safety, 2.5, false);
  picture.circle({p, circles.prediction}, prediction, 2.5, false);
  picture.legend("detection circle", detection);
  picture.legend("safety circle", safety);
  picture.legend("prediction circle", prediction);
}

void draw_obstacles(Picture& picture, const Snapshot& world, Disc circle) {
  for (const Body& body : world.moving().bodies()) {
    const BodySet alone({body});
    const bool is_near = alone.clearance(circle.centre, circle.radius) < circle.radius;
    picture.bodies({&body, 1}, is_near ? detected : colours::obstacle);
  }
}

}  // namespace

const Frame& frame_at(const Record& record, double t) {
  const auto after = std::find_if(record.frames.begin(), record.frames.end(),
                                  [t](const Frame& f) { return f.t > t + 1e-9; });
  return after == record.frames.begin() ? *after : *std::prev(after);
}

void draw_radar_moments(const Record& record, const World& world, std::span<const double> moments,
                        const std::string& title, const std::filesystem::path& stem) {
  const Scenario& scenario = record.scene.scenario;
  const auto& params = std::get<RadarParams>(scenario.navigator);
  for (std::size_t k = 0; k < moments.size(); ++k) {
    const Frame& frame = frame_at(record, moments[k]);
    Picture picture(
        world.map->bounds(),
        fmt::format("{}: t = {:.1f} s, δ = {:.2f}", title, frame.t, frame.avoidance_cost), 900);
    picture.walls(*world.map);
    const Snapshot now = world.at(frame.t);
    draw_obstacles(picture, now, {frame.pose.position, frame.radius + params.detection_range});
    std::vector<Vec2> way;
    for (const Frame& f : record.frames)
      if (f.t <= frame.t) way.push_back(f.pose.position);
    picture.line(way, colours::path, 2.5);
    if (!record.paths.empty() && record.paths.front().path.size() > 2)
      picture.line(record.paths.front().path, {0.8, 0.1, 0.1, 0.6}, 1.5, true);
    picture.swarm(frame.pose, frame.radius);
    draw_circles(picture, params, frame);
    picture.mark(*scenario.goal, "goal", colours::goal);
    picture.write(fmt::format("{}-{}.png", stem.string(), k + 1));
  }
}

}  // namespace microswarm::cli
