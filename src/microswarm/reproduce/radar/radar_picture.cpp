// SPDX-License-Identifier: Apache-2.0
#include "microswarm/reproduce/radar/radar_picture.hpp"
#include "microswarm/navigation/radar/wait_zone.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <memory>

#include "microswarm/core/angles.hpp"
#include "microswarm/core/file.hpp"
#include "microswarm/io/columns.hpp"
#include "microswarm/report/picture.hpp"

namespace microswarm::reproduce {
namespace {

namespace fs = std::filesystem;

constexpr Colour detection{0.55, 0.35, 0.15, 1};
constexpr Colour safety{0.95, 0.65, 0.0, 1};
constexpr Colour prediction{0.80, 0.15, 0.15, 1};
constexpr Colour detected_colour{0.97, 0.72, 0.66, 0.95};
constexpr Colour planned{0.8, 0.1, 0.1, 0.6};
constexpr Colour waiting{0.5, 0.5, 0.5, 1};
constexpr Colour tree_colour{0.35, 0.65, 0.35, 0.5};
constexpr Colour velocity{0.0, 0.30, 0.60, 1};
constexpr Colour driven{0.0, 0.38, 0.27, 1};
constexpr Colour deviation{0.35, 0.35, 0.35, 1};
constexpr Colour moment_mark{0.13, 0.15, 0.18, 1};

constexpr double pixels = 900;
constexpr double dot_px = 4.5;      // radius of a waypoint's dot
constexpr double head_px = 10;      // length of an arrow's head
constexpr double arrow_length = 2;  // at the swarm's maximum speed, in swarm radii
constexpr double min_cost = 0.005;  // α is drawn above this δ
constexpr int max_pictures = 20;

/// The navigator's circles; before its first look, those of its parameters.
RadarCircles circles_at(const RadarRun& run, std::size_t frame) {
  if (run.looks[frame]) return run.looks[frame]->circles;
  return circles_of(std::get<RadarParams>(run.record.scene.scenario.navigator),
                    run.record.frames[frame].radius);
}

// The safety circle may coincide with the detection circle, so one is dashed and the other wide.
void draw_circles(Picture& picture, const RadarCircles& circles, Vec2 p) {
  picture.circle({p, circles.detection}, detection, 4.5, false);
  picture.circle({p, circles.safety}, safety, 2, true);
  picture.circle({p, circles.prediction}, prediction, 2, false);
}

void draw_obstacles(Picture& picture, const Snapshot& world, Disc circle) {
  for (const Body& body : world.moving().bodies())
    picture.bodies({&body, 1}, distance(circle.centre, body) < circle.radius ? detected_colour
                                                                             : colours::obstacle);
}

void draw_plan(Picture& picture, const Record& record, double um_per_px) {
  if (record.plans.empty()) return;
  const Plan& plan = record.plans.front().plan;
  picture.tree(plan.tree, tree_colour);
  picture.line(plan.path, planned, 1.5, true);
  for (std::size_t k = 1; k + 1 < plan.path.size(); ++k)
    picture.disc({plan.path[k], dot_px * um_per_px}, planned);
}

void arrow(Picture& picture, Vec2 from, Vec2 way, Colour colour, double head) {
  if (norm(way) < head) return;
  const Vec2 tip = from + way;
  const Vec2 back = (head / norm(way)) * way;
  const Vec2 aside = 0.45 * Vec2{-back.y, back.x};
  picture.line(std::array{from, tip}, colour, 2.5);
  picture.line(std::array{tip - back + aside, tip, tip - back - aside}, colour, 2.5);
}

/// Time [s] over which velocity arrows extend.
double arrow_time(const Scenario& scenario) {
  const SwarmLimits swarm = limits_of(scenario.swarm);
  return arrow_length * swarm.radius / swarm.max_speed;
}

/// Draws velocities of the obstacles and the swarm, and the direction v_t from which it deviates by
/// α.
void draw_velocities(Picture& picture, const RadarRun& run, const World& world, std::size_t number,
                     double um_per_px) {
  const Frame& frame = run.record.frames[number];
  const double head = head_px * um_per_px;
  const double seconds = arrow_time(run.record.scene.scenario);
  for (const Obstacle& obstacle : world.obstacles)
    if (const Placement at = placement(obstacle.motion, frame.t); at.present)
      arrow(picture, at.pose.position, seconds * at.velocity, velocity, head);
  const Vec2 p = frame.pose.position;
  if (frame.speed > 0)
    arrow(picture, p, seconds * frame.speed * unit_vector(frame.pose.heading), driven, head);
  if (frame.avoidance_cost <= min_cost || !run.looks[number]) return;
  const Vec2 towards = run.looks[number]->target - p;
  const double reach = 1.2 * run.looks[number]->circles.detection;
  if (norm(towards) <= 0) return;
  const Vec2 end = p + (reach / norm(towards)) * towards;
  picture.line(std::array{p, end}, deviation, 1.5, true);
  picture.text(
      end,
      fmt::format("α = {:.0f}°", degrees(turn_between(frame.pose.heading, heading_of(towards)))),
      deviation);
}

/// Marks P0, P1, … with their times on the path, up to the moment `last`.
void mark_moments(Picture& picture, const Record& record, std::span<const double> moments,
                  std::size_t last) {
  for (std::size_t k = 0; k < last; ++k)
    picture.mark(record.frames[frame_at(record, moments[k])].pose.position,
                 fmt::format("P{}, {:.1f} s", k, moments[k]), moment_mark);
}

void draw_wait_areas(Picture& picture, const RadarParams& params) {
  for (const WaitZone& area : params.wait_zones) {
    std::vector<Vec2> outline = outline_of(area).outer;
    outline.push_back(outline.front());
    picture.line(outline, waiting, 1.5, true);
  }
}

void legend(Picture& picture, const RadarParams& params, const Record& record) {
  picture.legend("swarm", colours::swarm, true);
  picture.legend("its way", colours::path);
  picture.legend("obstacle", colours::obstacle, true);
  picture.legend("detected", detected_colour, true);
  picture.legend("detection circle", detection);
  picture.legend("safety circle", safety);
  picture.legend("prediction circle", prediction);
  const double seconds = arrow_time(record.scene.scenario);
  picture.legend(fmt::format("way in {:.1f} s: swarm", seconds), driven);
  picture.legend("of obstacles", velocity);
  if (!record.plans.empty()) picture.legend("way planned", planned);
  if (!record.plans.empty()) picture.legend("FMT* tree", tree_colour);
  if (!params.wait_zones.empty()) picture.legend("wait area", waiting);
}

std::string title_of(const RadarRun& run, const std::string& title, const Frame& frame) {
  std::string out =
      fmt::format("{}: t = {:.1f} s, δ = {:.2f}", title, frame.t, frame.avoidance_cost);
  if (run.collided()) out += fmt::format(", collided at {:.1f} s", run.record.result.metrics.time);
  return out;
}

/// A frame as in the table of the curves.
struct CurveRow {
  double t = 0;
  Vec2 at;
  double delta = 0;
  double gap = 0;
  double prediction = 0;
  double safety = 0;
  double detection = 0;
  NavigatorState state = NavigatorState::hold;
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.t, {"t", Unit::s, {}, "Time."});
    visit(self.at, {"", Unit::um, {}, "Position of the swarm."});
    visit(self.delta, {"delta", Unit::none, {}, "Avoidance cost."});
    visit(self.gap, {"gap", Unit::um, {}, "Gap to the nearest obstacle."});
    visit(self.prediction, {"r_p", Unit::um, {}, "Radius of the prediction circle."});
    visit(self.safety, {"r_f", Unit::um, {}, "Radius of the safety circle."});
    visit(self.detection, {"r_d", Unit::um, {}, "Radius of the detection circle."});
    visit(self.state, {"state", Unit::none, {}, "State of the navigator."});
  }
};

}  // namespace

Plot cost_plot(const RadarRun& run, const std::string& title, double paper_mean, double y_max) {
  const Metrics& metrics = run.record.result.metrics;
  Plot plot{.title = title,
            .x_label = "time (s)",
            .y_label = "avoidance cost δ",
            .series = {{.label = "measured", .x = {}, .y = {}},
                       {.label = fmt::format("its mean, {:.3f}", metrics.avoidance.mean_cost),
                        .x = {0, metrics.time},
                        .y = {metrics.avoidance.mean_cost, metrics.avoidance.mean_cost}}},
            .levels = {{fmt::format("paper's mean, {:.2f}", paper_mean), paper_mean}},
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
  const double um_per_px = std::max(view.width(), view.height()) / pixels;
  std::vector<std::unique_ptr<Picture>> pictures;
  for (int k = 1; k <= max_pictures; ++k)
    for (const char* end : {"png", "svg", "pdf"})
      fs::remove(fmt::format("{}-{}.{}", stem.string(), k, end));
  for (std::size_t k = 0; k < moments.size(); ++k) {
    const std::size_t number = frame_at(record, moments[k]);
    const Frame& frame = record.frames[number];
    const RadarCircles circles = circles_at(run, number);
    const Vec2 p = frame.pose.position;
    pictures.push_back(std::make_unique<Picture>(view, title_of(run, title, frame), pixels));
    Picture& picture = *pictures.back();
    picture.walls(*world.map);
    draw_wait_areas(picture, params);
    draw_plan(picture, record, um_per_px);
    draw_obstacles(picture, world.at(frame.t), {p, circles.detection});
    std::vector<Vec2> way;
    for (std::size_t i = 0; i <= number; ++i) way.push_back(record.frames[i].pose.position);
    picture.line(way, colours::path, 2.5);
    picture.mark(*record.scene.scenario.goal, "goal", colours::goal);
    picture.swarm(frame.pose, frame.radius);
    draw_circles(picture, circles, p);
    draw_velocities(picture, run, world, number, um_per_px);
    mark_moments(picture, record, moments, k);
    legend(picture, params, record);
    picture.write_everywhere(fmt::format("{}-{}", stem.string(), k + 1));
  }
  const int columns = view.height() > view.width() ? 4 : 2;
  for (const char* end : {".png", ".svg", ".pdf"})
    write_sheet(pictures, columns, stem.string() + "-moments" + end);
}

void write_radar_run(const RadarRun& run, const fs::path& stem) {
  std::vector<CurveRow> rows;
  for (std::size_t k = 0; k < run.record.frames.size(); ++k) {
    const Frame& f = run.record.frames[k];
    const RadarCircles c = circles_at(run, k);
    rows.push_back({.t = f.t,
                    .at = f.pose.position,
                    .delta = f.avoidance_cost,
                    .gap = f.obstacle_clearance - f.radius,
                    .prediction = c.prediction,
                    .safety = c.safety,
                    .detection = c.detection,
                    .state = f.state});
  }
  write_file_atomically(stem.string() + ".csv", csv_table(rows));
  write_record(run.record, stem.string() + ".h5");
}

}  // namespace microswarm::reproduce
