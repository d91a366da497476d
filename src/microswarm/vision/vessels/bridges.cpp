// SPDX-License-Identifier: Apache-2.0
#include "microswarm/vision/vessels/bridges.hpp"

#include <algorithm>
#include <limits>
#include <numbers>
#include <numeric>
#include <opencv2/imgproc.hpp>
#include <queue>
#include <tuple>
#include <vector>

#include "microswarm/vision/image/mask_ops.hpp"

namespace microswarm::vision {
namespace {

const cv::Point neighbours[] = {{1, 0}, {0, 1},  {-1, 0},  {0, -1},
                                {1, 1}, {-1, 1}, {-1, -1}, {1, -1}};

/// Cheapest paths from the pieces to each pixel.
struct Reach {
  cv::Mat label;   ///< piece, 0 if not reached
  cv::Mat cost;    ///< cost of the path, 0 in the pieces
  cv::Mat parent;  ///< index of the predecessor, −1 in the pieces
};

struct Meeting {
  float cost;
  cv::Point a, b;  ///< neighbours reached from two different pieces
};

double step_length(cv::Point step) { return step.x != 0 && step.y != 0 ? std::numbers::sqrt2 : 1; }

float step_cost(const cv::Mat& cost, cv::Point p, cv::Point step) {
  return static_cast<float>(0.5 * (cost.at<float>(p) + cost.at<float>(p + step)) *
                            step_length(step));
}

Reach reach_from_pieces(const cv::Mat& set, const cv::Mat& cost, double most) {
  Reach reach;
  cv::connectedComponents(set, reach.label, 8, CV_32S);
  reach.cost = cv::Mat(set.size(), CV_32F, cv::Scalar(std::numeric_limits<float>::max()));
  reach.cost.setTo(0, set);
  reach.parent = cv::Mat(set.size(), CV_32S, cv::Scalar(-1));
  using Entry = std::tuple<float, int>;  // cost so far, pixel; ties in reading order
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  for (int i = 0; i < static_cast<int>(set.total()); ++i)
    if (set.data[i]) queue.emplace(0.0F, i);
  const cv::Rect frame({0, 0}, set.size());
  while (!queue.empty()) {
    const auto [so_far, index] = queue.top();
    queue.pop();
    const cv::Point p(index % set.cols, index / set.cols);
    if (so_far > reach.cost.at<float>(p)) continue;
    for (const cv::Point step : neighbours) {
      const cv::Point q = p + step;
      if (!frame.contains(q)) continue;
      const float total = so_far + step_cost(cost, p, step);
      if (total > most || total >= reach.cost.at<float>(q)) continue;
      reach.cost.at<float>(q) = total;
      reach.label.at<int>(q) = reach.label.at<int>(p);
      reach.parent.at<int>(q) = index;
      queue.emplace(total, q.y * set.cols + q.x);
    }
  }
  return reach;
}

std::vector<Meeting> meetings(const Reach& reach, const cv::Mat& cost, double most) {
  std::vector<Meeting> found;
  const cv::Rect frame({0, 0}, cost.size());
  for (int y = 0; y < cost.rows; ++y)
    for (int x = 0; x < cost.cols; ++x) {
      const cv::Point p(x, y);
      if (reach.label.at<int>(p) == 0) continue;
      for (const cv::Point step : {cv::Point(1, 0), {0, 1}, {1, 1}, {-1, 1}}) {
        const cv::Point q = p + step;
        if (!frame.contains(q) || reach.label.at<int>(q) == 0 ||
            reach.label.at<int>(q) == reach.label.at<int>(p))
          continue;
        const float total =
            reach.cost.at<float>(p) + reach.cost.at<float>(q) + step_cost(cost, p, step);
        if (total <= most) found.push_back({total, p, q});
      }
    }
  std::stable_sort(found.begin(), found.end(),
                   [](const Meeting& a, const Meeting& b) { return a.cost < b.cost; });
  return found;
}

/// Half the width of the piece near its pixel p: the depth at the end of an ascent.
float radius_near(const cv::Mat& depth, cv::Point p) {
  const cv::Rect frame({0, 0}, depth.size());
  for (bool climbing = true; climbing;) {
    climbing = false;
    const cv::Point from = p;
    for (const cv::Point step : neighbours)
      if (frame.contains(from + step) && depth.at<float>(from + step) > depth.at<float>(p)) {
        p = from + step;
        climbing = true;
      }
  }
  return depth.at<float>(p);
}

/// The pixels from `p` back to its piece; the last one belongs to the piece.
std::vector<cv::Point> path_back(const Reach& reach, cv::Point p) {
  std::vector<cv::Point> path{p};
  for (int i = reach.parent.at<int>(p); i >= 0; i = reach.parent.at<int>(p)) {
    p = {i % reach.parent.cols, i / reach.parent.cols};
    path.push_back(p);
  }
  return path;
}

void set_disc(cv::Mat& set, cv::Point centre, double radius) {
  const int r = cvFloor(radius);
  const cv::Rect frame({0, 0}, set.size());
  for (int y = -r; y <= r; ++y)
    for (int x = -r; x <= r; ++x) {
      const cv::Point p = centre + cv::Point(x, y);
      if (x * x + y * y <= radius * radius && frame.contains(p)) set.at<std::uint8_t>(p) = 255;
    }
}

int find_root(std::vector<int>& parents, int i) {
  while (parents[i] != i) i = parents[i] = parents[parents[i]];
  return i;
}

}  // namespace

int bridge_gaps(cv::Mat& set, const cv::Mat& cost, double most) {
  const Reach reach = reach_from_pieces(set, cost, most);
  const cv::Mat depth = depth_in(set);
  std::vector<int> joined(set.total() + 1);
  std::iota(joined.begin(), joined.end(), 0);
  int bridges = 0;
  for (const Meeting& m : meetings(reach, cost, most)) {
    const int a = find_root(joined, reach.label.at<int>(m.a));
    const int b = find_root(joined, reach.label.at<int>(m.b));
    if (a == b) continue;
    joined[a] = b;
    ++bridges;
    const auto from_a = path_back(reach, m.a);
    const auto from_b = path_back(reach, m.b);
    const double radius = std::max(
        1.0F,
        std::min(radius_near(depth, from_a.back()), radius_near(depth, from_b.back())) - 0.5F);
    for (const auto& path : {from_a, from_b})
      for (const cv::Point p : path) set_disc(set, p, radius);
  }
  return bridges;
}

}  // namespace microswarm::vision
