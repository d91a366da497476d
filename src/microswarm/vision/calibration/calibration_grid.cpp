// SPDX-License-Identifier: Apache-2.0
#include "microswarm/vision/calibration/calibration_grid.hpp"

#include <algorithm>
#include <cmath>
#include <compare>
#include <deque>
#include <limits>
#include <map>
#include <numbers>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <string>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/maths/statistics.hpp"
#include "microswarm/vision/image/blur.hpp"
#include "microswarm/vision/image/mat.hpp"
#include "microswarm/vision/scene/blobs.hpp"

namespace microswarm::vision {
namespace {

constexpr double dot_spread = 0.35;  // relative deviation of a dot's radius from the median
constexpr double corner_blur = 2;    // [px]
constexpr int light_side = 41;       // [px] over which the light is uniform
constexpr double corner_share =
    0.5;  // of a typical corner's response; a corner of a square alone has 0.25
constexpr double lattice_slack = 0.25;   // [pitches] maximum offset of a point
constexpr double neighbour_slack = 0.3;  // relative tolerance of the distance between neighbours

std::vector<Vec2> dots_in(const formats::Image& grey) {
  std::vector<Blob> dots;
  for (const ParticleTone tone : {ParticleTone::dark, ParticleTone::bright}) {
    std::vector<Blob> found = find_blobs(
        grey, {.tone = tone, .min_radius = 2, .max_radius = 1e4, .min_contrast = 15, .gap = 2});
    std::erase_if(found, [](const Blob& b) { return b.is_cut; });
    if (found.size() > dots.size()) dots = std::move(found);
  }
  std::vector<double> radii;
  radii.reserve(dots.size());
  for (const Blob& b : dots) radii.push_back(b.radius_px);
  const double typical = median(radii);
  std::vector<Vec2> positions;
  for (const Blob& b : dots)
    if (std::abs(b.radius_px - typical) < dot_spread * typical) positions.push_back(b.centre_px);
  return positions;
}

/// Saddle points of the grey value. The `wanted` strongest responses define the threshold of a
/// corner.
std::vector<Vec2> corners_in(const formats::Image& grey, std::size_t wanted) {
  cv::Mat smooth;
  as_mat(grey).convertTo(smooth, CV_32F);
  smooth = blurred(smooth, corner_blur);
  cv::Mat light;
  cv::blur(smooth, light, {light_side, light_side});
  smooth = 255 * smooth / (light + 1);
  cv::Mat xx;
  cv::Mat yy;
  cv::Mat xy;
  cv::Sobel(smooth, xx, CV_32F, 2, 0);
  cv::Sobel(smooth, yy, CV_32F, 0, 2);
  cv::Sobel(smooth, xy, CV_32F, 1, 1);
  const cv::Mat saddle = xy.mul(xy) - xx.mul(yy);
  cv::Mat highest;
  cv::dilate(saddle, highest, cv::Mat::ones(9, 9, CV_8U));
  std::vector<std::pair<float, cv::Point2f>> peaks;
  constexpr int margin = 6;
  for (int y = margin; y < saddle.rows - margin; ++y)
    for (int x = margin; x < saddle.cols - margin; ++x)
      if (const float s = saddle.at<float>(y, x); s > 1 && s == highest.at<float>(y, x))
        peaks.push_back({s, {static_cast<float>(x), static_cast<float>(y)}});
  std::stable_sort(peaks.begin(), peaks.end(),
                   [](const auto& a, const auto& b) { return a.first > b.first; });
  if (peaks.empty()) return {};
  const float typical = peaks[std::min(peaks.size(), wanted) / 2].first;
  std::vector<cv::Point2f> corners;
  for (const auto& [strength, at] : peaks)
    if (strength > corner_share * typical) corners.push_back(at);
  cv::cornerSubPix(as_mat(grey), corners, {5, 5}, {-1, -1},
                   {cv::TermCriteria::EPS + cv::TermCriteria::COUNT, 50, 1e-3});
  std::vector<Vec2> positions;
  positions.reserve(corners.size());
  for (const cv::Point2f c : corners) positions.push_back({c.x, c.y});
  return positions;
}

struct Node {
  int column = 0;
  int row = 0;
  auto operator<=>(const Node&) const = default;
};
using Lattice = std::map<Node, std::size_t>;  ///< the point at each node

/// Vector from a point to a typical neighbour, within 45° of the x axis; empty for fewer than two
/// points.
std::optional<Vec2> grid_step(const std::vector<Vec2>& points) {
  std::vector<double> nearest;
  nearest.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < points.size(); ++k)
      if (k != i) least = std::min(least, distance(points[i], points[k]));
    nearest.push_back(least);
  }
  const double pitch = median(nearest);
  if (!(pitch > 0 && std::isfinite(pitch))) return std::nullopt;
  // Neighbours lie in four directions, so four times their angles agree.
  Vec2 sum;
  for (const Vec2 a : points)
    for (const Vec2 b : points)
      if (a != b && std::abs(distance(a, b) - pitch) < neighbour_slack * pitch)
        sum += unit_vector(4 * heading_along(b - a));
  return pitch * unit_vector(heading_along(sum) / 4);
}

/// The points connected to `first` by steps along x and y, with their nodes.
Lattice lattice_from(const std::vector<Vec2>& points, std::size_t first, Vec2 step) {
  Lattice lattice{{{0, 0}, first}};
  std::vector<bool> used(points.size());
  used[first] = true;
  std::deque<Node> open{{0, 0}};
  while (!open.empty()) {
    const Node at = open.front();
    open.pop_front();
    const Vec2 here = points[lattice.at(at)];
    for (const auto& [dx, dy] : {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}}) {
      const Node next{at.column + dx, at.row + dy};
      if (lattice.contains(next)) continue;
      const Vec2 due = here + dx * step + dy * perpendicular(step);
      std::size_t best = 0;
      for (std::size_t k = 1; k < points.size(); ++k)
        if (distance(points[k], due) < distance(points[best], due)) best = k;
      if (used[best] || distance(points[best], due) > lattice_slack * norm(step)) continue;
      used[best] = true;
      lattice[next] = best;
      open.push_back(next);
    }
  }
  return lattice;
}

Lattice largest_lattice(const std::vector<Vec2>& points) {
  Lattice largest;
  const auto step = grid_step(points);
  if (!step) return largest;
  for (std::size_t i = 0; i < points.size() && 2 * largest.size() < points.size(); ++i) {
    Lattice lattice = lattice_from(points, i, *step);
    if (lattice.size() > largest.size()) largest = std::move(lattice);
  }
  return largest;
}

}  // namespace

std::vector<ScalePoint> find_grid(const formats::Image& picture, const GridParams& p) {
  const std::size_t wanted = static_cast<std::size_t>(p.columns) * p.rows;
  const auto name = [](auto columns, auto rows) {
    return std::to_string(columns) + "x" + std::to_string(rows);
  };
  const auto refuse = [&](const std::string& what) {
    throw InputError("grid: " + what + ", asked for is one of " + name(p.columns, p.rows));
  };
  const formats::Image grey = formats::to_grey(picture);
  const std::vector<Vec2> points =
      p.pattern == GridPattern::dots ? dots_in(grey) : corners_in(grey, wanted);
  if (points.size() > 20 * wanted + 1000)
    refuse(std::to_string(points.size()) + " points are no grid");
  const Lattice lattice = largest_lattice(points);
  if (lattice.size() < 4) refuse("none is seen");
  Node lo = lattice.begin()->first;
  Node hi = lo;
  for (const auto& [node, point] : lattice) {
    lo = {std::min(lo.column, node.column), std::min(lo.row, node.row)};
    hi = {std::max(hi.column, node.column), std::max(hi.row, node.row)};
  }
  const int columns = hi.column - lo.column + 1;
  const int rows = hi.row - lo.row + 1;
  const bool lies = columns == p.columns && rows == p.rows;
  const bool stands = columns == p.rows && rows == p.columns;
  if (lattice.size() != wanted || !(lies || stands))
    refuse(std::to_string(lattice.size()) + " points of a grid of " + name(columns, rows) +
           " are seen");
  std::vector<ScalePoint> grid;
  grid.reserve(wanted);
  for (int row = 0; row < p.rows; ++row)
    for (int column = 0; column < p.columns; ++column) {
      // Rows of the lattice run down in the picture, those of the grid up. An upright grid is
      // turned left by 90°.
      const Node node =
          lies ? Node{lo.column + column, hi.row - row} : Node{hi.column - row, hi.row - column};
      grid.push_back({points[lattice.at(node)], p.pitch * Vec2{1.0 * column, 1.0 * row}});
    }
  return grid;
}

}  // namespace microswarm::vision
