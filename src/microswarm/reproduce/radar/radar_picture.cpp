// SPDX-License-Identifier: Apache-2.0
#include "microswarm/reproduce/radar/radar_picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "microswarm/core/fields/overloaded.hpp"
#include "microswarm/core/text/file.hpp"
#include "microswarm/io/columns.hpp"
#include "microswarm/report/picture.hpp"
#include "microswarm/report/radar_view.hpp"

namespace microswarm::reproduce {
namespace {

namespace fs = std::filesystem;

constexpr report::Colour moment_mark{0.13, 0.15, 0.18, 1};

constexpr double pixels = 900;
constexpr int max_pictures = 20;

RadarCircles circles_at(const RadarRun& run, std::size_t frame) {
  return report::radar_circles(run.record, frame, run.looks[frame]);
}

/// Marks P0, P1, … with their times on the path, up to the moment `last`.
void mark_moments(report::Picture& picture, const experiment::Record& record,
                  std::span<const double> moments, std::size_t last) {
  for (std::size_t k = 0; k < last; ++k)
    picture.mark(record.frames[frame_at(record, moments[k])].pose.position,
                 fmt::format("P{}, {:.1f} s", k, moments[k]), moment_mark);
}

std::string frame_title(const RadarRun& run, const std::string& title,
                        const experiment::Frame& frame) {
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
    visit(self.t, s("t", "Time."));
    visit(self.at, um("", "Position of the swarm."));
    visit(self.delta, plain("delta", "Avoidance cost."));
    visit(self.gap, um("gap", "Gap to the nearest obstacle."));
    visit(self.prediction, um("r_p", "Radius of the prediction circle."));
    visit(self.safety, um("r_f", "Radius of the safety circle."));
    visit(self.detection, um("r_d", "Radius of the detection circle."));
    visit(self.state, plain("state", "State of the navigator."));
  }
};

}  // namespace

report::Plot cost_plot(const RadarRun& run, const std::string& title, double paper_mean,
                       double y_max) {
  const experiment::Metrics& metrics = run.record.result.metrics;
  report::Plot plot{
      .title = title,
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
  for (const experiment::Frame& frame : run.record.frames) {
    plot.series[0].x.push_back(frame.t);
    plot.series[0].y.push_back(frame.avoidance_cost);
  }
  for (const Period& period : periods_detected(run.record))
    plot.bands.push_back({period.from, period.to});
  return plot;
}

Box part_that_matters(const RadarRun& run, const World& world, std::span<const double> moments) {
  constexpr double edge = 1.1;
  const experiment::Record& record = run.record;
  const Vec2 end = *record.scene.scenario.goal;
  Box box{end, end};
  const auto include = [&](Vec2 p, double r) {
    box.lo = {std::min(box.lo.x, p.x - r), std::min(box.lo.y, p.y - r)};
    box.hi = {std::max(box.hi.x, p.x + r), std::max(box.hi.y, p.y + r)};
  };
  for (std::size_t k = 0; k < record.frames.size(); ++k)
    include(record.frames[k].pose.position, edge * circles_at(run, k).detection);
  const Box passage = box;
  for (const double t : moments) {
    const Snapshot then = world.at(t);
    for (const Body& body : then.moving().bodies())
      std::visit(Overloaded{[&](const Disc& disc) {
                              if (disc.centre.x > passage.lo.x && disc.centre.x < passage.hi.x)
                                include(disc.centre, edge * disc.radius);
                            },
                            [](const Polygon&) {}},
                 body.shape);
  }
  const Box& all = world.map->bounds();
  return {{std::max(box.lo.x, all.lo.x), std::max(box.lo.y, all.lo.y)},
          {std::min(box.hi.x, all.hi.x), std::min(box.hi.y, all.hi.y)}};
}

void draw_radar_moments(const RadarRun& run, const World& world, std::span<const double> moments,
                        const std::string& title, const fs::path& stem, std::optional<Box> part) {
  const experiment::Record& record = run.record;
  const Box view = part.value_or(world.map->bounds());
  std::vector<std::unique_ptr<report::Picture>> pictures;
  for (int k = 1; k <= max_pictures; ++k)
    for (const char* end : {"png", "svg", "pdf"})
      fs::remove(fmt::format("{}-{}.{}", stem.string(), k, end));
  for (std::size_t k = 0; k < moments.size(); ++k) {
    const std::size_t number = frame_at(record, moments[k]);
    const experiment::Frame& frame = record.frames[number];
    pictures.push_back(
        std::make_unique<report::Picture>(view, frame_title(run, title, frame), pixels));
    report::Picture& picture = *pictures.back();
    report::draw_radar_view(picture, record, world, number, run.looks[number]);
    mark_moments(picture, record, moments, k);
    picture.write_everywhere(fmt::format("{}-{}", stem.string(), k + 1));
  }
  const int columns = view.height() > view.width() ? 4 : 2;
  for (const char* end : {".png", ".svg", ".pdf"})
    report::write_sheet(pictures, columns, stem.string() + "-moments" + end);
}

void write_radar_run(const RadarRun& run, const fs::path& stem) {
  std::vector<CurveRow> rows;
  for (std::size_t k = 0; k < run.record.frames.size(); ++k) {
    const experiment::Frame& f = run.record.frames[k];
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
  write_file_atomically(stem.string() + ".csv", io::csv_table(rows));
  experiment::write_record(run.record, stem.string() + ".h5");
}

}  // namespace microswarm::reproduce
