// SPDX-License-Identifier: Apache-2.0
#include "microswarm/rig/watch/picture_light.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "microswarm/vision/image/mat.hpp"

namespace microswarm::rig {
namespace {

constexpr double awaited = 1;  // [s] from a first excess to its note, which has the extremes

}  // namespace

double mean_grey(const formats::Image& picture) { return cv::mean(vision::as_mat(picture))[0]; }

double detail_of(const formats::Image& picture) {
  constexpr double sd_of_median = 1.4826;
  cv::Mat half, bends;
  cv::resize(vision::as_mat(picture), half, {picture.width / 2, picture.height / 2}, 0, 0,
             cv::INTER_AREA);
  cv::Laplacian(half, bends, CV_16S);
  std::array<int, 2048> counts{};
  double squares = 0;
  for (int y = 1; y + 1 < bends.rows; ++y)
    for (int x = 1; x + 1 < bends.cols; ++x) {
      const int bend = std::abs(bends.at<std::int16_t>(y, x));
      ++counts[static_cast<std::size_t>(std::min(bend, 2047))];
      squares += 1.0 * bend * bend;
    }
  const int total = std::max(1, (bends.rows - 2) * (bends.cols - 2));
  int median = 0;
  for (int below = 0;
       median < 2047 && 2 * (below += counts[static_cast<std::size_t>(median)]) < total; ++median) {
  }
  const double noise = sd_of_median * median;
  const double grey = std::max(1.0, cv::mean(half)[0]);
  return std::sqrt(std::max(0.0, squares / total - noise * noise)) / grey;
}

void RelativeValue::take(double value, double t) {
  now_ = t;
  if (reference_ <= 0) {
    if (value <= 0) return;
    reference_ = value;
  }
  const double share = value / reference_;
  share_ = share;
  lowest_ = std::min(lowest_, share);
  highest_ = std::max(highest_, share);
  if ((share < limits_.note_low || share > limits_.note_high) && !due_) due_ = t + awaited;
  if (share >= limits_.fault_low && share <= limits_.fault_high) {
    beyond_since_.reset();
    return;
  }
  if (!beyond_since_) beyond_since_ = t;
  if (t - *beyond_since_ < patience_ || !fault_.empty()) return;
  fault_ = fmt::format("{} is {:.0f} % of that at the start, allowed {:.0f} % or more", name_,
                       100 * share, 100 * limits_.fault_low);
  if (share > limits_.fault_high)
    fault_ = fmt::format("{} is {:.0f} % of that at the start, allowed {:.0f} % or less", name_,
                         100 * share, 100 * limits_.fault_high);
}

std::string RelativeValue::take_note() {
  if (told_ || !due_ || (now_ < *due_ && fault_.empty())) return {};
  told_ = true;
  if (highest_ <= limits_.note_high)
    return fmt::format("{} has fallen to {:.0f} % of that at the start", name_, 100 * lowest_);
  if (lowest_ >= limits_.note_low)
    return fmt::format("{} has risen to {:.0f} % of that at the start", name_, 100 * highest_);
  return fmt::format("{} varies between {:.0f} and {:.0f} % of that at the start", name_,
                     100 * lowest_, 100 * highest_);
}

}  // namespace microswarm::rig
