// SPDX-License-Identifier: Apache-2.0
#include "microswarm/vision/vessels/field_of_view.hpp"

#include <opencv2/imgproc.hpp>

#include "microswarm/vision/image/mask_ops.hpp"
#include "microswarm/vision/image/mat.hpp"

namespace microswarm::vision {
namespace {

constexpr int darkest_view = 20;       // of 255: a surround is darker in every channel
constexpr double min_surround = 0.02;  // share of the picture
constexpr double min_view = 0.2;
constexpr double min_of_bright = 0.98;  // fraction of the bright pixels in one piece
constexpr double min_solidity = 0.95;   // area of that piece relative to its convex hull

cv::Mat brightest_channel(const cv::Mat& picture) {
  if (picture.channels() == 1) return picture.clone();
  std::vector<cv::Mat> channels;
  cv::split(picture, channels);
  cv::Mat brightest = channels[0];
  for (const cv::Mat& channel : channels) cv::max(brightest, channel, brightest);
  return brightest;
}

/// Whether a surround leaves out at least three of the picture's corners: what is dark elsewhere
/// are channels.
bool leaves_out_corners(const cv::Mat& view) {
  const int right = view.cols - 1;
  const int bottom = view.rows - 1;
  int corners = 0;
  for (const cv::Point p : {cv::Point(0, 0), {right, 0}, {0, bottom}, {right, bottom}})
    corners += view.at<std::uint8_t>(p) == 0;
  return corners >= 3;
}

double solidity(const cv::Mat& piece) {
  std::vector<cv::Point> points, hull;
  cv::findNonZero(piece, points);
  cv::convexHull(points, hull);
  return static_cast<double>(points.size()) / (cv::contourArea(hull) + 1);
}

}  // namespace

formats::Mask field_of_view(const formats::Image& image) {
  const cv::Mat picture = as_mat(image);
  const cv::Mat whole(picture.size(), CV_8U, cv::Scalar(255));
  cv::Mat bright = brightest_channel(picture);
  cv::medianBlur(bright, bright, 5);
  bright = bright > darkest_view;

  const double total = static_cast<double>(picture.total());
  const double bright_count = cv::countNonZero(bright);
  cv::Mat view = largest_piece(bright);
  const double view_count = cv::countNonZero(view);
  if (bright_count > (1 - min_surround) * total || view_count < min_view * total ||
      view_count < min_of_bright * bright_count)
    return to_mask(whole);
  if (!leaves_out_corners(view)) return to_mask(whole);
  fill_holes(view, total);
  return to_mask(solidity(view) < min_solidity ? whole : view);
}

}  // namespace microswarm::vision
