// SPDX-License-Identifier: Apache-2.0
#include "microswarm/vision/scene/level_line.hpp"

#include <array>
#include <cassert>

namespace microswarm::vision {
namespace {

/// Offset to a neighbour: 0 is up; each increment turns right by 90° as displayed.
cv::Point step(int direction) {
  constexpr std::array<int, 4> along{0, 1, 0, -1};
  return {along[direction & 3], along[(direction + 3) & 3]};
}

}  // namespace

/// Walks around the piece with the outside on the left. At an inner pixel with an outer one towards
/// `out`, the line crosses between the two. The next crossing is at the same pixel, at the one
/// ahead, or at the one ahead and to the left.
std::vector<Vec2> level_line(const cv::Mat& field, float level, cv::Point start) {
  const cv::Rect all(0, 0, field.cols, field.rows);
  const auto inside = [&](cv::Point p) { return all.contains(p) && field.at<float>(p) > level; };
  const auto crossing = [&](cv::Point p, cv::Point outer) {
    double share = 0.5;
    if (all.contains(outer)) {
      const float high = field.at<float>(p);
      share = (high - level) / (high - field.at<float>(outer));
    }
    return Vec2{p.x + share * (outer.x - p.x), p.y + share * (outer.y - p.y)};
  };
  assert(inside(start) && !inside(start + step(0)));  // else there is no end
  std::vector<Vec2> line;
  cv::Point at = start;
  int out = 0;
  do {
    line.push_back(crossing(at, at + step(out)));
    const cv::Point ahead = at + step(out + 1);
    if (!inside(ahead)) {
      ++out;  // a corner of the piece
    } else if (inside(ahead + step(out))) {
      at = ahead + step(out);
      --out;
    } else {
      at = ahead;
    }
    out &= 3;
  } while (at != start || out != 0);
  return line;
}

}  // namespace microswarm::vision
