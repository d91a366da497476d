// SPDX-License-Identifier: Apache-2.0
#include "microswarm/vision/image/pixel_runs.hpp"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

#include "microswarm/core/maths/rng.hpp"

namespace microswarm::vision {
namespace {

TEST(PixelRuns, PiecesAreThoseOfLabels) {
  Rng rng(7, Purpose::test);
  for (int trial = 0; trial < 200; ++trial) {
    cv::Mat set(1 + static_cast<int>(rng.below(20)), 1 + static_cast<int>(rng.below(40)), CV_8U);
    const double share = rng.uniform();
    for (int y = 0; y < set.rows; ++y)
      for (int x = 0; x < set.cols; ++x)
        set.at<std::uint8_t>(y, x) = rng.uniform() < share ? 255 : 0;
    cv::Mat labels, stats, centres;
    const int count = cv::connectedComponentsWithStats(set, labels, stats, centres, 4, CV_32S);
    const auto pieces = connected_runs(set);
    ASSERT_EQ(std::ssize(pieces), count - 1) << trial;
    cv::Mat ours = cv::Mat::zeros(set.size(), CV_32S);
    for (int k = 1; k < count; ++k) {
      const RunPiece& piece = pieces[static_cast<std::size_t>(k - 1)];
      for (const PixelRun& run : piece.runs)
        ours(cv::Rect(run.begin, run.row, run.end - run.begin, 1)).setTo(k);
      EXPECT_EQ(piece.area, stats.at<int>(k, cv::CC_STAT_AREA)) << trial;
      EXPECT_EQ(piece.box,
                cv::Rect(stats.at<int>(k, cv::CC_STAT_LEFT), stats.at<int>(k, cv::CC_STAT_TOP),
                         stats.at<int>(k, cv::CC_STAT_WIDTH), stats.at<int>(k, cv::CC_STAT_HEIGHT)))
          << trial;
    }
    EXPECT_EQ(cv::countNonZero(ours != labels), 0) << trial;
  }
}

}  // namespace
}  // namespace microswarm::vision
