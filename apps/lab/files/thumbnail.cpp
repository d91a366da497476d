// SPDX-License-Identifier: Apache-2.0
#include "lab/files/thumbnail.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/fields/overloaded.hpp"
#include "microswarm/experiment/plant/make_plant.hpp"
#include "microswarm/experiment/record/record.hpp"
#include "microswarm/experiment/scenario/scene.hpp"
#include "microswarm/experiment/session/session.hpp"
#include "microswarm/report/picture.hpp"

namespace microswarm::lab {
namespace {

constexpr double max_width = 320;           // px
constexpr double max_height = 240;          // px
constexpr double finest = 0.5;              // px
constexpr std::size_t max_bytes = 200'000;  // a larger drawing is made coarser
constexpr std::size_t max_drawings = 2000;
constexpr std::size_t max_robots = 500;  // maximum number of robots drawn
constexpr double mark_radius = 5;        // px
constexpr std::uint64_t max_drawn_bytes = 64 << 20;

std::string hex(const report::Colour& colour) {
  const auto part = [](double share) { return static_cast<int>(std::lround(255 * share)); };
  return fmt::format("#{:02x}{:02x}{:02x}", part(colour.red), part(colour.green),
                     part(colour.blue));
}

/// Draws a world in pixels, y down.
class Drawing {
 public:
  Drawing(const Box& view, double tolerance)
      : view_(view),
        scale_(std::min(max_width / view.width(), max_height / view.height())),
        tolerance_(tolerance) {}

  void polygon(const Polygon& shape, const report::Colour& colour) {
    std::string path;
    ring(shape.outer, path);
    for (const auto& hole : shape.holes) ring(hole, path);
    if (!path.empty())
      svg_ += fmt::format("<path fill=\"{}\" fill-rule=\"evenodd\" d=\"{}\"/>", hex(colour), path);
  }
  void disc(Vec2 centre, double radius_px, const report::Colour& colour, bool is_ring = false) {
    const Vec2 p = at(centre);
    svg_ += fmt::format(
        "<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{:.1f}\" {}/>", p.x, p.y, radius_px,
        is_ring ? fmt::format("fill=\"none\" stroke=\"{}\" stroke-width=\"2\"", hex(colour))
                : fmt::format("fill=\"{}\"", hex(colour)));
  }
  void line(std::span<const Vec2> points, const report::Colour& colour) {
    if (points.size() < 2) return;
    std::string path;
    for (const Vec2 point : points) {
      const Vec2 p = at(point);
      path += fmt::format("{}{:.1f} {:.1f}", path.empty() ? 'M' : 'L', p.x, p.y);
    }
    svg_ += fmt::format("<path fill=\"none\" stroke=\"{}\" stroke-width=\"2\" d=\"{}\"/>",
                        hex(colour), path);
  }
  double px(double length) const { return std::max(length * scale_, 1.0); }
  std::size_t size() const { return svg_.size(); }
  std::string text() const {
    const double width = view_.width() * scale_, height = view_.height() * scale_;
    return fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" "
        "viewBox=\"0 0 {0:.1f} {1:.1f}\"><rect x=\"0.5\" y=\"0.5\" width=\"{3:.1f}\" "
        "height=\"{4:.1f}\" fill=\"none\" stroke=\"{5}\"/>{2}</svg>\n",
        width, height, svg_, width - 1, height - 1, hex(report::colours::wall_edge));
  }

 private:
  Vec2 at(Vec2 p) const { return {(p.x - view_.lo.x) * scale_, (view_.hi.y - p.y) * scale_}; }

  /// Draws a ring without points nearer to the previous one than the tolerance.
  void ring(const std::vector<Vec2>& points, std::string& path) const {
    const Box box = bounding_box(std::span<const Vec2>(points));
    if (std::max(box.width(), box.height()) * scale_ < tolerance_) return;
    Vec2 last{-1e9, -1e9};
    char move = 'M';
    for (const Vec2 point : points) {
      const Vec2 p = at(point);
      if (std::max(std::abs(p.x - last.x), std::abs(p.y - last.y)) < tolerance_) continue;
      path += fmt::format("{}{:.1f} {:.1f}", std::exchange(move, 'L'), p.x, p.y);
      last = p;
    }
    path += 'Z';
  }

  Box view_;
  double scale_;
  double tolerance_;
  std::string svg_;
};

void draw(Drawing& drawing, const Body& body, const report::Colour& colour) {
  std::visit(Overloaded{[&](const Disc& disc) {
                          drawing.disc(disc.centre, drawing.px(disc.radius), colour);
                        },
                        [&](const Polygon& polygon) { drawing.polygon(polygon, colour); }},
             body.shape);
}

/// Positions of the robots at t = 0 [µm].
std::vector<Vec2> first_robots(const experiment::Scene& scene) {
  const auto plant =
      experiment::make_kinematic_plant(scene.scenario, experiment::build_world(scene));
  const auto truth = plant->ground_truth();
  if (!truth) return {};
  return {truth->robots.begin(), truth->robots.end()};
}

constexpr std::size_t max_points = 300;  ///< of a path travelled

/// Positions of the swarm, or the robots' mean, over a run [µm].
std::vector<Vec2> travelled(const experiment::Record& record) {
  std::vector<Vec2> points;
  const std::size_t every = record.frames.size() / max_points + 1;
  points.reserve(max_points + 1);
  for (std::size_t i = 0; i < record.frames.size(); i += every)
    points.push_back(record.frames[i].pose.position);
  return points;
}

std::string drawn(const experiment::Scene& scene, std::span<const Vec2> path, double tolerance) {
  const experiment::Scenario& scenario = scene.scenario;
  Drawing drawing(scene.map.bounds, tolerance);
  for (const Polygon& wall : scene.map.walls) drawing.polygon(wall, report::colours::wall_edge);
  for (const Disc& disc : scene.map.discs)
    drawing.disc(disc.centre, drawing.px(disc.radius), report::colours::wall_edge);
  std::vector<Body> bodies;
  for (const Obstacle& obstacle : scenario.obstacles) append_bodies(obstacle, 0, 0, bodies);
  for (const Body& body : bodies) draw(drawing, body, report::colours::obstacle);
  drawing.line(path, report::colours::trail);
  if (scenario.robots) {
    const auto& robots = *scenario.robots;
    const auto starts = first_robots(scene);
    const auto few = [](const auto& list) {
      return std::span(list).first(std::min(list.size(), max_robots));
    };
    for (const Vec2 start : few(starts)) drawing.disc(start, 2, report::colours::swarm);
    for (const Vec2 goal : few(robots.goals))
      drawing.disc(goal, mark_radius, report::colours::goal, true);
  }
  if (scenario.start) drawing.disc(scenario.start->position, mark_radius, report::colours::swarm);
  if (scenario.goal) drawing.disc(*scenario.goal, mark_radius, report::colours::goal, true);
  return drawing.text();
}

}  // namespace

std::string thumbnail(const std::filesystem::path& file) {
  experiment::Record record;
  if (experiment::is_record(file)) {
    if (std::filesystem::file_size(file) > max_drawn_bytes)
      throw InputError(file.string(), "the record is too large for a small drawing");
    record = experiment::read_record(file);
  } else {
    record.scene = experiment::load_scene(experiment::read_scenario(file), file.parent_path());
  }
  const experiment::Scene& scene = record.scene;
  const std::vector<Vec2> path = travelled(record);
  std::string svg;
  for (double tolerance = finest; tolerance < max_width; tolerance *= 2) {
    svg = drawn(scene, path, tolerance);
    if (svg.size() <= max_bytes) break;
  }
  return svg;
}

const std::string& Thumbnails::of(const std::filesystem::path& scenario) {
  const auto written = std::filesystem::last_write_time(scenario);
  const auto found = drawn_.find(scenario);
  if (found != drawn_.end() && found->second.written == written) return found->second.svg;
  if (drawn_.size() >= max_drawings) drawn_.clear();
  return (drawn_[scenario] = {written, thumbnail(scenario)}).svg;
}

}  // namespace microswarm::lab
