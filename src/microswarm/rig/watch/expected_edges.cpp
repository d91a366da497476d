// SPDX-License-Identifier: Apache-2.0
#include "microswarm/rig/watch/expected_edges.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "microswarm/rig/perception/walls_in_picture.hpp"
#include "microswarm/vision/image/mat.hpp"

namespace microswarm::rig {
namespace {

constexpr double calm = 1.2;  // [px] standard deviation of the blur
constexpr std::size_t max_edges = 1500;
constexpr double border_width = 2.5;  // [px] from the workspace's border
constexpr int picture_margin = 3;     // [px] in which no edge is expected
constexpr int still_cell = 5;         // [px] of which each has one edge of a still at most
constexpr double still_contrast = 8;  // times the noise, of an edge of a still
constexpr double noise_of_median =
    1.4826;  // standard deviation of normal noise over its median size

std::vector<ExpectedEdge> thinned(std::vector<ExpectedEdge> edges) {
  if (edges.size() <= max_edges) return edges;
  std::vector<ExpectedEdge> some;
  some.reserve(max_edges);
  for (std::size_t i = 0; i < max_edges; ++i) some.push_back(edges[i * edges.size() / max_edges]);
  return some;
}

/// Slope of a float picture.
Vec2 slope_of(const cv::Mat& field, int x, int y) {
  return {static_cast<double>(field.at<float>(y, x + 1) - field.at<float>(y, x - 1)),
          static_cast<double>(field.at<float>(y + 1, x) - field.at<float>(y - 1, x))};
}

Vec2 grey_slope(const cv::Mat& grey, int x, int y) {
  return {1.0 * grey.at<std::uint8_t>(y, x + 1) - grey.at<std::uint8_t>(y, x - 1),
          1.0 * grey.at<std::uint8_t>(y + 1, x) - grey.at<std::uint8_t>(y - 1, x)};
}

bool is_at_border(Vec2 p, const Box& bounds, double width) {
  return std::min({p.x - bounds.lo.x, bounds.hi.x - p.x, p.y - bounds.lo.y, bounds.hi.y - p.y}) <
         width;
}

}  // namespace

std::vector<ExpectedEdge> wall_edges(const Map& map, const CameraView& view, bool border) {
  const formats::Mask mask = walls_in_picture(map, view.scale, view.width, view.height);
  cv::Mat walls;
  vision::to_mat(mask).convertTo(walls, CV_32F, 1 / 255.0);
  cv::GaussianBlur(walls, walls, {}, 1);
  std::vector<ExpectedEdge> edges;
  const double width = border_width * view.scale.um_per_px;
  const auto add = [&](int x, int y, int right, int down) {
    const double here = walls.at<float>(y, x) - 0.5;
    const double there = walls.at<float>(y + down, x + right) - 0.5;
    if ((here > 0) == (there > 0)) return;
    const double share = here / (here - there);
    const Vec2 at{x + share * right, y + share * down};
    const Vec2 slope =
        (1 - share) * slope_of(walls, x, y) + share * slope_of(walls, x + right, y + down);
    if (norm(slope) < 0.1) return;
    if (!border && is_at_border(view.scale.to_world(at), map.bounds(), width)) return;
    edges.push_back({at, slope / norm(slope)});
  };
  for (int y = picture_margin; y < walls.rows - picture_margin; ++y)
    for (int x = picture_margin; x < walls.cols - picture_margin; ++x) {
      add(x, y, 1, 0);
      add(x, y, 0, 1);
    }
  return thinned(std::move(edges));
}

std::vector<ExpectedEdge> still_edges(const formats::Image& still,
                                      std::span<const vision::Ring> moving) {
  const cv::Mat grey = calm_picture(still);
  const double least = std::max(2.0, still_contrast * edge_noise(grey));
  const auto moves = [&](Vec2 at) {
    return std::any_of(moving.begin(), moving.end(), [&](const vision::Ring& ring) {
      return distance(ring.centre_px, at) < ring.radius_px;
    });
  };
  std::vector<ExpectedEdge> edges;
  for (int top = picture_margin; top + still_cell < grey.rows - picture_margin; top += still_cell)
    for (int left = picture_margin; left + still_cell < grey.cols - picture_margin;
         left += still_cell) {
      double strongest = least;
      std::optional<ExpectedEdge> best;
      for (int y = top; y < top + still_cell; ++y)
        for (int x = left; x < left + still_cell; ++x) {
          const Vec2 slope = grey_slope(grey, x, y);
          const double strength = norm(slope);
          if (strength <= strongest || moves({1.0 * x, 1.0 * y})) continue;
          strongest = strength;
          best = {{1.0 * x, 1.0 * y}, -slope / strength};
        }
      if (best) edges.push_back(*best);
    }
  return thinned(std::move(edges));
}

cv::Mat calm_picture(const formats::Image& picture) {
  cv::Mat blurred;
  cv::GaussianBlur(vision::as_mat(picture), blurred, {}, calm);
  return blurred;
}

double edge_noise(const cv::Mat& grey) {
  constexpr int spacing = 7;  // [px]
  std::array<int, 256> counts{};
  int total = 0;
  for (int y = picture_margin; y < grey.rows - picture_margin; y += spacing)
    for (int x = picture_margin; x < grey.cols - picture_margin; x += spacing) {
      const Vec2 slope = grey_slope(grey, x, y);
      ++counts[static_cast<std::size_t>(std::abs(slope.x))];
      ++counts[static_cast<std::size_t>(std::abs(slope.y))];
      total += 2;
    }
  int below = 0;
  for (std::size_t size = 0; size < counts.size(); ++size) {
    const int with = below + counts[size];
    if (2 * with >= total) {  // the median, interpolated within a grey value
      const double share = (0.5 * total - below) / std::max(1, counts[size]);
      return noise_of_median * (static_cast<double>(size) + share);
    }
    below = with;
  }
  return 0;
}

}  // namespace microswarm::rig
