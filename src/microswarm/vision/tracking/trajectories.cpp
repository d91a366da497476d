// SPDX-License-Identifier: Apache-2.0
#include "microswarm/vision/tracking/trajectories.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "microswarm/vision/image/mat.hpp"
#include "microswarm/vision/image/strokes.hpp"
#include "microswarm/vision/tracking/track_marks.hpp"

namespace microswarm::vision {
namespace {

constexpr double paler = 0.45;  // share of the picture, the rest is white

/// The picture in colour and pale, so that lines stand out.
formats::Image pale(const formats::Image& picture) {
  formats::Image shown{picture.width, picture.height, 3, {}};
  shown.pixels.resize(shown.index(0, shown.height));
  cv::Mat out = as_mat(shown);
  if (picture.channels == 3)
    as_mat(picture).copyTo(out);
  else
    cv::cvtColor(as_mat(picture), out, cv::COLOR_GRAY2RGB);
  out.convertTo(out, -1, paler, 255 * (1 - paler));
  return shown;
}

}  // namespace

formats::Image draw_trajectories(const formats::Image& picture, std::span<const TrackRow> rows,
                                 double um_per_px) {
  formats::Image shown = pale(picture);
  cv::Mat out = as_mat(shown);
  const int thick = std::max(1, static_cast<int>(std::lround(picture.width / 800.0)));
  const int dot = (thick + 1) << fraction_bits;
  std::map<int, const TrackRow*> last;
  for (const TrackRow& row : rows) {
    const cv::Scalar colour = track_colour(row.id);
    const TrackRow*& before = last[row.id];
    if (before)
      cv::line(out, fine(before->at_px), fine(row.at_px), colour,
               before->frame + 1 == row.frame ? thick + 1 : 1, cv::LINE_AA, fraction_bits);
    else
      cv::circle(out, fine(row.at_px), dot, colour, cv::FILLED, cv::LINE_AA, fraction_bits);
    before = &row;
  }
  for (const auto& [id, row] : last)
    cv::circle(out, fine(row->at_px), 2 * dot, track_colour(id), thick, cv::LINE_AA, fraction_bits);
  draw_scale_bar(out, um_per_px);
  return shown;
}

}  // namespace microswarm::vision
