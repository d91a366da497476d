// SPDX-License-Identifier: Apache-2.0
#include "microswarm/report/run_picture.hpp"

#include <fmt/format.h>

#include <cmath>
#include <vector>

#include "microswarm/experiment/scenario/scene.hpp"
#include "microswarm/report/map_background.hpp"
#include "microswarm/report/radar_marks.hpp"
#include "microswarm/report/robots_report.hpp"

namespace microswarm {
namespace {

constexpr int ghosts = 6;  // earlier obstacle positions
constexpr double faint = 0.18;

std::string run_title(const Record& record) {
  if (record.frames.empty()) return title_of(record) + ": start";
  const Metrics& m = record.result.metrics;
  return fmt::format("{}: {} after {:.1f} s, {:.0f} µm", title_of(record),
                     to_string(record.result.status), m.time, m.length);
}

void draw_obstacles(Picture& picture, const World& world, double end) {
  Colour colour = colours::obstacle;
  colour.alpha = faint;
  for (int k = 0; k < ghosts && end > 0; ++k)
    picture.bodies(world.at(end * k / ghosts).moving().bodies(), colour);
  picture.bodies(world.at(end).moving().bodies());
}

}  // namespace

std::unique_ptr<Picture> draw_run(const Record& record, const ReportOptions& options,
                                  std::span<const PlanEvent* const> numbered) {
  const Scenario& scenario = record.scene.scenario;
  if (scenario.robots)
    return draw_robots_at(record, options, record.robots.empty() ? 0 : record.robots.size() - 1);
  const World world = build_world(record.scene);
  auto picture = std::make_unique<Picture>(world.map->bounds(), run_title(record));
  draw_ground(*picture, *world.map, options);
  draw_obstacles(*picture, world, record.frames.empty() ? 0 : record.frames.back().t);
  const bool is_going_on = record.result.status == Status::running && !record.plans.empty();
  if (!record.frames.empty()) {
    std::vector<Vec2> trail;
    trail.reserve(record.frames.size());
    for (const Frame& frame : record.frames) trail.push_back(frame.pose.position);
    picture->line(trail, colours::path, 3);
    if (is_going_on) picture->line(record.plans.back().plan.path, colours::path, 2, true);
    draw_radar_marks(*picture, record, world);
    picture->swarm(record.frames.back().pose, record.frames.back().radius);
  }
  draw_ends(*picture, scenario);
  for (std::size_t k = 0; k < numbered.size(); ++k)
    picture->mark(frame_at(record, numbered[k]->t).pose.position, fmt::format("{}", k + 1),
                  colours::path);
  if (!record.frames.empty()) {
    picture->legend("swarm", colours::swarm, true);
    picture->legend("travelled path", colours::path);
    if (is_going_on) picture->legend("dashed: newest plan", colours::path);
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

}  // namespace microswarm
