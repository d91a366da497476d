// SPDX-License-Identifier: Apache-2.0
#include "microswarm/vision/image/mask_ops.hpp"

#include <algorithm>
#include <opencv2/imgproc.hpp>
#include <vector>

namespace microswarm::vision {
namespace {

struct Pieces {
  cv::Mat labels;  ///< 0 outside the set
  std::vector<int> areas;
};

Pieces label_pieces(const cv::Mat& set, int connectivity) {
  cv::Mat labels, stats, centres;
  const int count =
      cv::connectedComponentsWithStats(set, labels, stats, centres, connectivity, CV_32S);
  std::vector<int> areas(count);
  for (int i = 0; i < count; ++i) areas[i] = stats.at<int>(i, cv::CC_STAT_AREA);
  return {labels, areas};
}

cv::Mat labelled(const cv::Mat& labels, const std::vector<char>& kept) {
  cv::Mat set(labels.size(), CV_8U);
  for (int y = 0; y < labels.rows; ++y)
    for (int x = 0; x < labels.cols; ++x)
      set.at<std::uint8_t>(y, x) = kept[labels.at<int>(y, x)] ? 255 : 0;
  return set;
}

cv::Mat distance_to_zero(const cv::Mat& set) {
  cv::Mat distance;
  cv::distanceTransform(set, distance, cv::DIST_L2, cv::DIST_MASK_PRECISE);
  return distance;
}

}  // namespace

cv::Mat largest_piece(const cv::Mat& set) {
  const Pieces pieces = label_pieces(set, 8);
  if (pieces.areas.size() < 2) return set.clone();
  const auto largest = std::max_element(pieces.areas.begin() + 1, pieces.areas.end());
  return pieces.labels == static_cast<int>(largest - pieces.areas.begin());
}

std::vector<float> values_in(const cv::Mat& values, const cv::Mat& set) {
  std::vector<float> list;
  for (int y = 0; y < values.rows; ++y)
    for (int x = 0; x < values.cols; ++x)
      if (set.at<std::uint8_t>(y, x)) list.push_back(values.at<float>(y, x));
  return list;
}

int count_pieces(const cv::Mat& set) {
  cv::Mat labels;
  return cv::connectedComponents(set, labels, 8, CV_32S) - 1;
}

cv::Mat highest_around(const cv::Mat& values, int side) {
  cv::Mat highest;
  cv::dilate(values, highest, cv::getStructuringElement(cv::MORPH_RECT, {side, side}),
             {(side - 1) / 2, (side - 1) / 2}, 1, cv::BORDER_CONSTANT, cv::Scalar(0));
  return highest;
}

cv::Mat without_small_pieces(const cv::Mat& set, double min_area) {
  const Pieces pieces = label_pieces(set, 8);
  std::vector<char> kept(pieces.areas.size(), 0);
  for (std::size_t i = 1; i < kept.size(); ++i) kept[i] = pieces.areas[i] >= min_area;
  return labelled(pieces.labels, kept);
}

cv::Mat pieces_with(const cv::Mat& set, const cv::Mat& seeds) {
  const Pieces pieces = label_pieces(set, 8);
  std::vector<char> kept(pieces.areas.size(), 0);
  for (int y = 0; y < set.rows; ++y)
    for (int x = 0; x < set.cols; ++x)
      if (seeds.at<std::uint8_t>(y, x)) kept[pieces.labels.at<int>(y, x)] = 1;
  kept[0] = 0;
  return labelled(pieces.labels, kept);
}

void fill_holes(cv::Mat& set, double max_area) {
  const Pieces gaps = label_pieces(~set, 4);
  std::vector<char> filled(gaps.areas.size(), 0);
  for (std::size_t i = 1; i < filled.size(); ++i) filled[i] = gaps.areas[i] <= max_area;
  const auto open = [&](int x, int y) { filled[gaps.labels.at<int>(y, x)] = 0; };
  for (int x = 0; x < set.cols; ++x) open(x, 0), open(x, set.rows - 1);
  for (int y = 0; y < set.rows; ++y) open(0, y), open(set.cols - 1, y);
  set |= labelled(gaps.labels, filled);
}

cv::Mat opened(const cv::Mat& set, double diameter) {
  if (cv::countNonZero(set) == static_cast<int>(set.total())) return set.clone();
  const double reach = (diameter + 1) / 2;
  const cv::Mat centres = distance_to_zero(set) >= reach;
  if (cv::countNonZero(centres) == 0) return cv::Mat::zeros(set.size(), CV_8U);
  return distance_to_zero(~centres) < reach;
}

cv::Mat grown(const cv::Mat& set, double radius) {
  if (cv::countNonZero(set) == 0) return set.clone();
  return distance_to_zero(~set) <= radius;
}

void widen_corners(cv::Mat& set) {
  const auto at = [&](int x, int y) -> std::uint8_t& { return set.at<std::uint8_t>(y, x); };
  for (int y = 0; y + 1 < set.rows; ++y)
    for (int x = 0; x + 1 < set.cols; ++x) {
      const bool falling = at(x, y) && at(x + 1, y + 1);
      const bool rising = at(x + 1, y) && at(x, y + 1);
      if (falling && !at(x + 1, y) && !at(x, y + 1)) at(x + 1, y) = 255;
      if (rising && !at(x, y) && !at(x + 1, y + 1)) at(x + 1, y + 1) = 255;
    }
}

cv::Mat depth_in(const cv::Mat& set) { return distance_to_zero(set); }

}  // namespace microswarm::vision
