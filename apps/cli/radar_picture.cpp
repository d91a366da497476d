// SPDX-License-Identifier: Apache-2.0
#include "radar_picture.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "microswarm/report/picture.hpp"

namespace microswarm::cli {
namespace {

namespace fs = std::filesystem;

constexpr Colour detection{0.55, 0.35, 0.15, 1};
constexpr Colour safety{0.95, 0.65, 0.0, 1};
constexpr Colour prediction{0.80, 0.15, 0.15, 1};
constexpr Colour detected_colour{0.97, 0.72, 0.66, 0.95};
constexpr Colour planned{0.8, 0.1, 0.1, 0.6};
constexpr Colour waiting{0.5, 0.5, 0.5, 1};
constexpr Colour goal{0.40, 0.25, 0.65, 1};

constexpr double pixels = 900;
constexpr double dot_px = 4.5;  // radius of a waypoint
constexpr int most_pictures = 20;

/// As the navigator had them; before its first look as its parameters say.
RadarCircles circles_at(const RadarRun& run, std::size_t frame) {
  if (run.looks[frame]) return run.looks[frame]->circles;
  return circles_of(std::get<RadarParams>(run.record.scene.scenario.navigator),
                    run.record.frames[frame].radius);
}

// The safety circle may lie on the detection circle: that one is broad, this one dashed.
void draw_circles(Picture& picture, const RadarCircles& circles, Vec2 p) {
  picture.circle({p, circles.detection}, detection, 4.5, false);
  picture.circle({p, circles.safety}, safety, 2, true);
  picture.circle({p, circles.prediction}, prediction, 2, false);
}

void draw_obstacles(Picture& picture, const Snapshot& world, Disc circle) {
  for (const Body& body : world.moving().bodies())
    picture.bodies({&body, 1}, edge_distance(body, circle.centre) < circle.radius
                                   ? detected_colour
                                   : colours::obstacle);
}

/// From the start through the waypoints that it did not leave out at once.
std::vector<Vec2> planned_way(const Record& record) {
  if (record.paths.empty() || record.paths.front().path.size() < 2) return {};
  std::vector<Vec2> way{record.scene.scenario.start->position};
  const auto& path = record.paths.front().path;
  way.insert(way.end(), path.begin(), path.end());
  return way;
}

void draw_plan(Picture& picture, const std::vector<Vec2>& way, double um_per_px) {
  if (way.empty()) return;
  picture.line(way, planned, 1.5, true);
  for (std::size_t k = 1; k + 1 < way.size(); ++k)
    picture.disc({way[k], dot_px * um_per_px}, planned);
}

void draw_wait_areas(Picture& picture, const RadarParams& params) {
  for (const WaitArea& area : params.wait_areas) {
    std::vector<Vec2> outline = outline_of(area).outer;
    outline.push_back(outline.front());
    picture.line(outline, waiting, 1.5, true);
  }
}

void legend(Picture& picture, const RadarParams& params, bool has_plan) {
  picture.legend("swarm", colours::swarm, true);
  picture.legend("its way", colours::path);
  picture.legend("obstacle", colours::obstacle, true);
  picture.legend("detected", detected_colour, true);
  picture.legend("detection circle", detection);
  picture.legend("safety circle", safety);
  picture.legend("prediction circle", prediction);
  if (has_plan) picture.legend("way planned", planned);
  if (!params.wait_areas.empty()) picture.legend("wait area", waiting);
}

std::string title_of(const RadarRun& run, const std::string& title, const Frame& frame) {
  std::string out =
      fmt::format("{}: t = {:.1f} s, δ = {:.2f}", title, frame.t, frame.avoidance_cost);
  if (run.collided()) out += fmt::format(", collided at {:.1f} s", run.record.result.metrics.time);
  return out;
}

}  // namespace

Plot cost_plot(const RadarRun& run, const std::string& title, double paper_mean, double y_max) {
  const Metrics& metrics = run.record.result.metrics;
  Plot plot{.title = title,
            .x_label = "time (s)",
            .y_label = "avoidance cost δ",
            .series = {{.label = "ours", .x = {}, .y = {}}},
            .levels = {{fmt::format("paper's mean, {:.2f}", paper_mean), paper_mean},
                       {fmt::format("our mean, {:.2f}", metrics.avoidance.mean_cost),
                        metrics.avoidance.mean_cost}},
            .band_label = "obstacle in the detection circle",
            .key_below = true,
            .x_min = 0,
            .x_max = metrics.time,
            .y_min = 0,
            .y_max = y_max};
  if (run.collided()) plot.title += fmt::format(", collided at {:.1f} s", metrics.time);
  for (const Frame& frame : run.record.frames) {
    plot.series[0].x.push_back(frame.t);
    plot.series[0].y.push_back(frame.avoidance_cost);
  }
  for (const Period& period : periods_detected(run.record))
    plot.bands.push_back({period.from, period.to});
  return plot;
}

Box part_that_matters(const RadarRun& run, const World& world, std::span<const double> moments) {
  constexpr double edge = 1.1;
  const Record& record = run.record;
  const Vec2 end = *record.scene.scenario.goal;
  Box box{end, end};
  const auto include = [&](Vec2 p, double r) {
    box.lo = {std::min(box.lo.x, p.x - r), std::min(box.lo.y, p.y - r)};
    box.hi = {std::max(box.hi.x, p.x + r), std::max(box.hi.y, p.y + r)};
  };
  for (std::size_t k = 0; k < record.frames.size(); ++k)
    include(record.frames[k].pose.position, edge * circles_at(run, k).detection);
  const Box way = box;
  for (const double t : moments)
    for (const Body& body : world.at(t).moving().bodies())
      if (const Disc* disc = std::get_if<Disc>(&body.shape))
        if (disc->centre.x > way.lo.x && disc->centre.x < way.hi.x)
          include(disc->centre, edge * disc->radius);
  const Box& all = world.map->bounds();
  return {{std::max(box.lo.x, all.lo.x), std::max(box.lo.y, all.lo.y)},
          {std::min(box.hi.x, all.hi.x), std::min(box.hi.y, all.hi.y)}};
}

void draw_radar_moments(const RadarRun& run, const World& world, std::span<const double> moments,
                        const std::string& title, const fs::path& stem, std::optional<Box> part) {
  const Record& record = run.record;
  const auto& params = std::get<RadarParams>(record.scene.scenario.navigator);
  const Box view = part.value_or(world.map->bounds());
  const std::vector<Vec2> plan = planned_way(record);
  for (int k = 1; k <= most_pictures; ++k) fs::remove(fmt::format("{}-{}.png", stem.string(), k));
  for (std::size_t k = 0; k < moments.size(); ++k) {
    const std::size_t number = frame_at(record, moments[k]);
    const Frame& frame = record.frames[number];
    const RadarCircles circles = circles_at(run, number);
    const Vec2 p = frame.pose.position;
    Picture picture(view, title_of(run, title, frame), pixels);
    picture.walls(*world.map);
    draw_wait_areas(picture, params);
    draw_obstacles(picture, world.at(frame.t), {p, circles.detection});
    draw_plan(picture, plan, std::max(view.width(), view.height()) / pixels);
    std::vector<Vec2> way;
    for (std::size_t i = 0; i <= number; ++i) way.push_back(record.frames[i].pose.position);
    picture.line(way, colours::path, 2.5);
    picture.mark(*record.scene.scenario.goal, "goal", goal);
    picture.swarm(frame.pose, frame.radius);
    draw_circles(picture, circles, p);
    legend(picture, params, !plan.empty());
    picture.write(fmt::format("{}-{}.png", stem.string(), k + 1));
  }
}

}  // namespace microswarm::cli
