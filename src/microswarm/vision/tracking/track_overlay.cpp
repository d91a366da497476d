// SPDX-License-Identifier: Apache-2.0
#include "microswarm/vision/tracking/track_overlay.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <string>

#include "microswarm/core/maths/maths.hpp"
#include "microswarm/vision/image/mat.hpp"
#include "microswarm/vision/image/strokes.hpp"
#include "microswarm/vision/tracking/track_marks.hpp"

namespace microswarm::vision {
namespace {

constexpr std::size_t trail_length = 20;  // frames
constexpr int forgotten_after = 20;       // frames unseen
constexpr int max_numbered = 100;         // robots; beyond this, numbers are omitted

std::string short_number(const char* form, double value) {
  char text[64];
  std::snprintf(text, sizeof text, form, value);
  return text;
}

double legend_size(const cv::Mat& picture) { return std::clamp(picture.cols / 1200.0, 0.35, 2.0); }

void take_in_colour(const formats::Image& picture, PictureSize size, formats::Image& colour) {
  colour.width = size.width;
  colour.height = size.height;
  colour.channels = 3;
  colour.pixels.resize(3 * static_cast<std::size_t>(size.width) * size.height);
  cv::Mat small = as_mat(picture), out = as_mat(colour);
  if (size != PictureSize{picture.width, picture.height})
    cv::resize(as_mat(picture), small, out.size(), 0, 0, cv::INTER_AREA);
  if (picture.channels == 3)
    small.copyTo(out);
  else
    cv::cvtColor(small, out, cv::COLOR_GRAY2RGB);
}

/// Draws the scale bar at the lower left, and time and count at the upper left.
void draw_legend(cv::Mat& picture, double um_per_px, double t, std::size_t robots) {
  const double size = legend_size(picture);
  const int step = static_cast<int>(30 * size);
  draw_scale_bar(picture, um_per_px);
  draw_text(picture, short_number("%.2f s", t) + ", " + std::to_string(robots) + " robots",
            {step, step + step / 4}, size);
}

}  // namespace

cv::Scalar track_colour(int id) {
  static const std::array<cv::Scalar, 6> colours{
      {{230, 159, 0}, {86, 180, 233}, {0, 158, 115}, {240, 228, 66}, {0, 114, 178}, {213, 94, 0}}};
  return colours[static_cast<std::size_t>(id) % colours.size()];
}

void draw_scale_bar(cv::Mat& picture, double um_per_px) {
  const double size = legend_size(picture);
  const int step = static_cast<int>(30 * size);
  const double bar = scale_bar_length(picture.cols * um_per_px);
  const int length = static_cast<int>(std::lround(bar / um_per_px));
  const cv::Rect box(step, picture.rows - step - step / 4, length, std::max(2, step / 5));
  cv::rectangle(picture, box + cv::Size(2, 2) - cv::Point(1, 1), black, cv::FILLED);
  cv::rectangle(picture, box, white, cv::FILLED);
  draw_text(picture, short_number("%g um", bar), {step, box.y - step / 3}, size);
}

double scale_bar_length(double width) {
  const double about = width / 5;
  const double ten = maths::power(10.0, static_cast<int>(std::floor(maths::log10(about))));
  for (const double times : {5.0, 2.0})
    if (times * ten <= about) return times * ten;
  return ten;
}

PictureSize TrackOverlay::size(PictureSize of_pictures) {
  const double width = of_pictures.width, height = of_pictures.height;
  const double times = std::sqrt(max_pixels / (width * height));
  if (times >= 1) return of_pictures;
  const auto shrunk = [times](double side) {  // even, as encoders need it
    return std::max(2, 2 * static_cast<int>(0.5 * times * side));
  };
  return {shrunk(width), shrunk(height)};
}

void TrackOverlay::follow(const std::vector<TrackRow>& rows, int frame, int height,
                          double um_per_px) {
  for (const TrackRow& row : rows) {
    if (static_cast<std::size_t>(row.id) >= trails_.size()) trails_.resize(row.id + 1);
    auto& trail = trails_[row.id];
    if (!trail) trail.emplace();
    trail->last_frame = frame;
    trail->places_px.push_back(place_in_picture(row.position, height, um_per_px));
    if (trail->places_px.size() > trail_length) trail->places_px.pop_front();
  }
  for (auto& trail : trails_)
    if (trail && trail->last_frame + forgotten_after < frame) trail.reset();
}

const formats::Image& TrackOverlay::draw(const VideoFrame& frame,
                                         const std::vector<TrackRow>& rows) {
  const PictureSize shown = size({frame.picture.width, frame.picture.height});
  const double times = std::max(shown.width, shown.height) * 1.0 /
                       std::max(frame.picture.width, frame.picture.height);
  const double um_per_px = um_per_px_ / times;
  follow(rows, frame.index, shown.height, um_per_px);
  take_in_colour(frame.picture, shown, shown_);
  cv::Mat picture = as_mat(shown_);
  for (const TrackRow& row : rows) {
    const Trail& trail = *trails_[row.id];
    const cv::Scalar colour = track_colour(row.id);
    for (std::size_t i = 1; i < trail.places_px.size(); ++i)
      cv::line(picture, fine(trail.places_px[i - 1]), fine(trail.places_px[i]), colour, 1,
               cv::LINE_AA, fraction_bits);
    const int radius =
        static_cast<int>(std::lround((row.radius / um_per_px + 2) * (1 << fraction_bits)));
    cv::circle(picture, fine(trail.places_px.back()), radius, colour, 1, cv::LINE_AA,
               fraction_bits);
  }
  const double text_size = std::clamp(picture.cols / 1600.0, 0.3, 1.5);
  if (rows.size() <= max_numbered)
    for (const TrackRow& row : rows) {
      const Vec2 at = trails_[row.id]->places_px.back();
      const double beside = row.radius / um_per_px + 3;
      draw_text(picture, std::to_string(row.id),
                {static_cast<int>(at.x + beside), static_cast<int>(at.y - beside)}, text_size);
    }
  draw_legend(picture, um_per_px, frame.t, rows.size());
  return shown_;
}

}  // namespace microswarm::vision
