// SPDX-License-Identifier: Apache-2.0
#include "microswarm/report/run_picture.hpp"

#include <fmt/format.h>

#include <cmath>
#include <vector>

#include "microswarm/core/maths/infinity.hpp"
#include "microswarm/experiment/scenario/scene.hpp"
#include "microswarm/experiment/session/playback.hpp"
#include "microswarm/report/map_background.hpp"
#include "microswarm/report/min_gap.hpp"
#include "microswarm/report/robots_report.hpp"

namespace microswarm::report {
namespace {

constexpr int ghosts = 6;  // earlier obstacle positions
constexpr double faint = 0.18;

std::string run_title(const experiment::Record& record) {
  if (record.frames.empty()) return default_title(record) + ": start";
  const experiment::Metrics& m = record.result.metrics;
  return fmt::format("{}: {} after {:.1f} s, {:.0f} µm", default_title(record),
                     to_string(record.result.status), m.time, m.length);
}

/// Draws the obstacles of a time [s], with the changes until then.
void draw_obstacles(Picture& picture, const experiment::Record& record, World& world, double t,
                    Colour fill) {
  if (!record.changes.empty()) world.obstacles = experiment::scenario_at(record, t).obstacles;
  picture.bodies(world.at(t).moving().bodies(), fill);
}

void draw_obstacles(Picture& picture, const experiment::Record& record, World& world) {
  const double end = record.frames.empty() ? 0 : record.frames.back().t;
  Colour earlier = colours::obstacle;
  earlier.alpha = faint;
  for (int k = 0; k < ghosts && end > 0; ++k)
    draw_obstacles(picture, record, world, end * k / ghosts, earlier);
  draw_obstacles(picture, record, world, end, colours::obstacle);
}

}  // namespace

std::unique_ptr<Picture> draw_run(const experiment::Record& record, const ReportOptions& options,
                                  std::span<const experiment::PlanEvent* const> numbered) {
  if (record.scene.scenario.robots)
    return draw_robots_at(record, options, record.robots.empty() ? 0 : record.robots.size() - 1);
  World world = experiment::build_world(record.scene);
  auto picture = std::make_unique<Picture>(world.map->bounds(), run_title(record));
  draw_ground(*picture, *world.map, options);
  draw_obstacles(*picture, record, world);
  const bool is_going_on = record.result.status == Status::running && !record.paths.empty();
  if (!record.frames.empty()) {
    std::vector<Vec2> trail;
    trail.reserve(record.frames.size());
    for (const experiment::Frame& frame : record.frames) trail.push_back(frame.pose.position);
    picture->line(trail, colours::trail, 3);
    if (is_going_on) picture->line(record.paths.back().path, colours::path, 2, true);
    draw_min_gap(*picture, record, world);
    picture->swarm(record.frames.back().pose, record.frames.back().radius);
  }
  draw_ends(*picture, experiment::scenario_at(record, infinity));
  for (std::size_t k = 0; k < numbered.size(); ++k)
    picture->mark(frame_at(record, numbered[k]->t).pose.position, fmt::format("{}", k + 1),
                  colours::path);
  if (!record.frames.empty()) {
    picture->legend("swarm", colours::swarm, true);
    picture->legend("travelled path", colours::trail);
    if (is_going_on) picture->legend("planned path, dashed", colours::path);
  }
  if (!numbered.empty()) picture->legend("moments of the report", colours::path, true);
  if (!world.obstacles.empty())
    picture->legend("moving obstacles, earlier places faint", colours::obstacle, true);
  return picture;
}

std::unique_ptr<Picture> draw_map(const Map& map, std::string_view title) {
  auto picture = std::make_unique<Picture>(map.bounds(), title);
  picture->walls(map);
  return picture;
}

std::unique_ptr<Picture> draw_plan(const Map& map, const Plan& plan, Vec2 start, const Disc& goal,
                                   std::string_view title) {
  auto picture = draw_map(map, title);
  picture->tree(plan.tree);
  picture->line(plan.path, colours::path, 3);
  picture->mark(start, "start");
  picture->circle(goal, colours::goal, 2);
  picture->mark(goal.centre, "goal", colours::goal);
  picture->legend("path", colours::path);
  if (!plan.tree.empty()) picture->legend("tree", colours::tree);
  return picture;
}

}  // namespace microswarm::report
