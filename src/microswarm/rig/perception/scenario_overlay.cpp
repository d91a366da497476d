// SPDX-License-Identifier: Apache-2.0
#include "microswarm/rig/perception/scenario_overlay.hpp"

#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>
#include <variant>

#include "microswarm/core/fields/overloaded.hpp"
#include "microswarm/vision/image/mat.hpp"
#include "microswarm/vision/image/strokes.hpp"

namespace microswarm::rig {
namespace {

// From Okabe & Ito's palette, which is safe for colour-blind readers.
const cv::Scalar wall_vermilion(213, 94, 0);
const cv::Scalar start_blue(86, 180, 233);
const cv::Scalar goal_purple(204, 121, 167);
constexpr double mark_px = 7;

class Canvas {
 public:
  Canvas(formats::Image& picture, const vision::CameraScale& scale)
      : mat_(vision::as_mat(picture)), scale_(scale) {}

  /// A line between places in the world, which may be far outside the picture.
  void line(Vec2 a, Vec2 b, const cv::Scalar& colour) {
    pixel_line(scale_.to_picture(a), scale_.to_picture(b), colour);
  }
  void ring(const std::vector<Vec2>& corners, const cv::Scalar& colour) {
    for (std::size_t i = 0, j = corners.size() - 1; i < corners.size(); j = i++)
      line(corners[j], corners[i], colour);
  }
  void circle(Vec2 centre, double radius, const cv::Scalar& colour) {
    constexpr int corners = 72;
    std::vector<Vec2> points;
    points.reserve(corners);
    for (int k = 0; k < corners; ++k)
      points.push_back(centre + radius * unit_vector(2 * std::numbers::pi * k / corners));
    ring(points, colour);
  }
  void cross(Vec2 position, const cv::Scalar& colour) {
    const Vec2 at = scale_.to_picture(position);
    for (const Vec2 diagonal : {Vec2{mark_px, mark_px}, Vec2{mark_px, -mark_px}})
      pixel_line(at - diagonal, at + diagonal, colour);
  }
  /// A line of three marks' length.
  void heading(const Pose2& pose, const cv::Scalar& colour) {
    const double length = 3 * mark_px * scale_.um_per_px;
    line(pose.position, pose.position + length * unit_vector(pose.heading), colour);
  }

 private:
  void pixel_line(Vec2 a, Vec2 b, const cv::Scalar& colour) {
    constexpr double farthest = 1e9;  // [px]
    for (const double v : {a.x, a.y, b.x, b.y})
      if (!(std::abs(v) < farthest)) return;
    const auto exact = [](Vec2 p) {
      return cv::Point2l(std::llround(p.x * (1 << vision::fraction_bits)),
                         std::llround(p.y * (1 << vision::fraction_bits)));
    };
    cv::Point2l from = exact(a), to = exact(b);
    const cv::Size2l size(std::int64_t{mat_.cols} << vision::fraction_bits,
                          std::int64_t{mat_.rows} << vision::fraction_bits);
    if (cv::clipLine(size, from, to))
      cv::line(mat_, cv::Point(from), cv::Point(to), colour, 2, cv::LINE_AA, vision::fraction_bits);
  }

  cv::Mat mat_;
  const vision::CameraScale& scale_;
};

void draw_walls(Canvas& canvas, const Map& map) {
  const Box& b = map.bounds();
  canvas.ring({b.lo, {b.hi.x, b.lo.y}, b.hi, {b.lo.x, b.hi.y}}, wall_vermilion);
  for (const Body& body : map.walls().bodies()) {
    std::visit(Overloaded{[&](const Disc& disc) {
                            canvas.circle(disc.centre, disc.radius, wall_vermilion);
                          },
                          [&](const Polygon& polygon) {
                            canvas.ring(polygon.outer, wall_vermilion);
                            for (const auto& hole : polygon.holes)
                              canvas.ring(hole, wall_vermilion);
                          }},
               body.shape);
  }
}

}  // namespace

void draw_scenario(formats::Image& picture, const experiment::Scenario& scenario, const Map& map,
                   const vision::CameraScale& scale) {
  Canvas canvas(picture, scale);
  draw_walls(canvas, map);
  if (scenario.start) {
    canvas.cross(scenario.start->position, start_blue);
    canvas.heading(*scenario.start, start_blue);
  }
  const auto draw_goal = [&](Vec2 goal) {
    canvas.cross(goal, goal_purple);
    canvas.circle(goal, scenario.goal_tolerance, goal_purple);
  };
  if (scenario.goal) draw_goal(*scenario.goal);
  if (!scenario.robots) return;
  for (const Vec2 start : scenario.robots->starts) canvas.cross(start, start_blue);
  for (const Vec2 goal : scenario.robots->goals) draw_goal(goal);
}

}  // namespace microswarm::rig
