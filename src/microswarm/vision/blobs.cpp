// SPDX-License-Identifier: Apache-2.0
#include "microswarm/vision/blobs.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <opencv2/imgproc.hpp>
#include <string>

#include "microswarm/core/error.hpp"
#include "microswarm/core/statistics.hpp"
#include "microswarm/vision/ground.hpp"
#include "microswarm/vision/level_line.hpp"
#include "microswarm/vision/mat.hpp"

namespace microswarm {
namespace {

constexpr int ground_rows = 8;  // one row in so many tells the noise of the ground
constexpr int margin = 2;       // working pixels along the outline that tell nothing of the grain
constexpr double noise_limit = 5;  // spreads of the ground that something must stand out

/// Pixels of the picture along a side of a working pixel: the coarser, the less noise and time.
int coarseness(const BlobParams& p) {
  const double fine = std::min(p.min_radius / 3, p.gap / 2);
  return fine >= 4 ? 4 : fine >= 2 ? 2 : 1;
}

/// Means of squares of `side` pixels; the border is repeated to fill the last ones.
cv::Mat coarse(const cv::Mat& mat, int side) {
  if (side == 1) return mat;
  const int right = (side - mat.cols % side) % side;
  const int below = (side - mat.rows % side) % side;
  cv::Mat padded = mat;
  if (right + below > 0) cv::copyMakeBorder(mat, padded, 0, below, 0, right, cv::BORDER_REPLICATE);
  cv::Mat small;
  cv::resize(padded, small, {padded.cols / side, padded.rows / side}, 0, 0, cv::INTER_AREA);
  return small;
}

/// Pixels that are looked at as 255, or an empty matrix when that is all.
cv::Mat seen_of(const Image& picture, const Mask* walls, int side) {
  if (!walls) return {};
  if (walls->width != picture.width || walls->height != picture.height)
    throw InputError("walls: " + std::to_string(walls->width) + "x" +
                     std::to_string(walls->height) + " pixels, the picture has " +
                     std::to_string(picture.width) + "x" + std::to_string(picture.height));
  cv::Mat hidden;
  cv::dilate(coarse(to_mat(*walls), side) > 0, hidden, cv::Mat::ones(3, 3, CV_8U));
  return ~hidden;
}

/// How far each pixel stands out of the ground, smoothed; 0 where nothing is seen.
cv::Mat rise_of(const cv::Mat& grey, const cv::Mat& seen, bool dark, double spread) {
  cv::Mat rise;
  cv::subtract(grey, ground_of(grey, seen), rise, cv::noArray(), CV_32F);
  if (dark) rise *= -1;
  const int side = 2 * static_cast<int>(std::ceil(2.5 * spread)) + 1;
  if (!seen.empty()) rise.setTo(0, ~seen);
  cv::GaussianBlur(rise, rise, {side, side}, spread, spread, cv::BORDER_REFLECT);
  if (seen.empty()) return rise;
  cv::Mat share;
  seen.convertTo(share, CV_32F, 1.0 / 255);
  cv::GaussianBlur(share, share, {side, side}, spread, spread, cv::BORDER_REFLECT);
  rise /= cv::max(share, 0.1F);
  rise.setTo(0, ~seen);
  return rise;
}

/// Spread of the ground around its surface, by the median of one pixel in seven.
double ground_spread(const cv::Mat& rise, const cv::Mat& seen) {
  std::vector<double> off;
  off.reserve(rise.total() / 7 + 1);
  for (std::size_t i = 0; i < rise.total(); i += 7)
    if (seen.empty() || seen.ptr<std::uint8_t>()[i]) off.push_back(std::abs(rise.ptr<float>()[i]));
  return 1.4826 * median(std::move(off));
}

struct Piece {
  cv::Rect box;
  int label = 0;
};

std::vector<Piece> pieces_of(const cv::Mat& set, cv::Mat& labels, double least_area) {
  cv::Mat stats;
  cv::Mat centres;
  const int count = cv::connectedComponentsWithStats(set, labels, stats, centres, 4, CV_32S);
  std::vector<Piece> pieces;
  for (int k = 1; k < count; ++k) {
    const int* s = stats.ptr<int>(k);
    if (s[cv::CC_STAT_AREA] < least_area) continue;
    pieces.push_back(
        {{s[cv::CC_STAT_LEFT], s[cv::CC_STAT_TOP], s[cv::CC_STAT_WIDTH], s[cv::CC_STAT_HEIGHT]},
         k});
  }
  return pieces;
}

float median_within(const cv::Mat& rise, const cv::Mat& labels, const Piece& piece) {
  std::vector<double> values;
  for (int y = piece.box.y; y < piece.box.br().y; ++y)
    for (int x = piece.box.x; x < piece.box.br().x; ++x)
      if (labels.at<int>(y, x) == piece.label) values.push_back(rise.at<float>(y, x));
  return static_cast<float>(median(std::move(values)));
}

/// Area, middle and ellipse of what the outline encloses; false for a line without area.
bool measure(Blob& blob) {
  std::vector<cv::Point2f> ring;
  ring.reserve(blob.outline_px.size());
  for (const Vec2 p : blob.outline_px)
    ring.emplace_back(static_cast<float>(p.x), static_cast<float>(p.y));
  const cv::Moments m = cv::moments(ring);
  if (!(m.m00 > 0)) return false;
  blob.centre_px = {m.m10 / m.m00, m.m01 / m.m00};
  blob.radius_px = std::sqrt(m.m00 / std::numbers::pi);
  const double mean = 0.5 * (m.mu20 + m.mu02) / m.m00;
  const double half = 0.5 * (m.mu20 - m.mu02) / m.m00;
  const double mixed = m.mu11 / m.m00;
  const double spread = std::hypot(half, mixed);
  blob.semi_major_px = 2 * std::sqrt(mean + spread);
  blob.semi_minor_px = 2 * std::sqrt(std::max(0.0, mean - spread));
  blob.angle = 0.5 * std::atan2(mixed, half);
  return true;
}

/// Mean square of the differences between neighbours in a row, over the pixels that `of` chooses.
template <class Choose>
double roughness(const cv::Mat& grey, const cv::Rect& box, int row_step, Choose&& of) {
  double squares = 0;
  double count = 0;
  for (int y = box.y; y < box.br().y; y += row_step) {
    const auto* row = grey.ptr<std::uint8_t>(y);
    for (int x = box.x; x + 1 < box.br().x; ++x) {
      if (!of(x, y)) continue;
      const int step = row[x + 1] - row[x];
      squares += step * step;
      ++count;
    }
  }
  return count > 0 ? squares / count : 0;
}

bool is_cut(const cv::Rect& box, const cv::Mat& labels, int label, const cv::Mat& seen) {
  if (box.x == 0 || box.y == 0 || box.br().x == labels.cols || box.br().y == labels.rows)
    return true;
  if (seen.empty()) return false;
  const cv::Rect around = box + cv::Size(2, 2) - cv::Point(1, 1);
  cv::Mat grown;
  cv::dilate(labels(around) == label, grown, cv::Mat::ones(3, 3, CV_8U));
  return cv::countNonZero(grown & ~seen(around)) > 0;
}

}  // namespace

std::vector<Blob> find_blobs(const Image& picture, const BlobParams& p, const Mask* walls) {
  const int side = coarseness(p);
  const cv::Mat seen = seen_of(picture, walls, side);
  if (picture.pixels.empty()) return {};
  const Image one = picture.channels == 1 ? Image{} : to_grey(picture);
  const cv::Mat fine = as_mat(picture.channels == 1 ? picture : one);
  const cv::Mat grey = coarse(fine, side);
  const cv::Mat rise = rise_of(grey, seen, p.tone == ParticleTone::dark, p.gap / 2 / side);
  const auto least =
      static_cast<float>(std::max(p.min_contrast, noise_limit * ground_spread(rise, seen)));

  // What stands out, then what of each piece does so by half as much as its middle.
  const double least_area = std::numbers::pi * std::pow(0.5 * p.min_radius / side, 2);
  cv::Mat labels;
  cv::Mat set = cv::Mat::zeros(rise.size(), CV_8U);
  cv::Mat level = cv::Mat::zeros(rise.size(), CV_32F);
  for (const Piece& piece : pieces_of(rise > least, labels, least_area)) {
    const float half = std::max(least, median_within(rise, labels, piece) / 2);
    const cv::Mat in = (labels(piece.box) == piece.label) & (rise(piece.box) > half);
    set(piece.box).setTo(255, in);
    level(piece.box).setTo(half, in);
  }
  const double noise =
      roughness(fine, {0, 0, fine.cols, fine.rows}, ground_rows, [&](int x, int y) {
        const cv::Point at(x / side, y / side);
        return labels.at<int>(at) == 0 && (seen.empty() || seen.at<std::uint8_t>(at));
      });
  std::vector<Blob> blobs;
  for (const Piece& piece : pieces_of(set, labels, least_area)) {
    Blob blob;
    blob.contrast = median_within(rise, labels, piece);
    cv::Point start = piece.box.tl();
    while (labels.at<int>(start) != piece.label) ++start.x;
    blob.outline_px = level_line(rise, level.at<float>(start), start);
    for (Vec2& q : blob.outline_px) q = side * q + 0.5 * (side - 1) * Vec2{1, 1};
    if (!measure(blob) || blob.radius_px < p.min_radius || blob.radius_px > p.max_radius) continue;
    const cv::Rect box(side * piece.box.tl(), side * piece.box.br());
    const cv::Rect inner(margin, margin, labels.cols - 2 * margin, labels.rows - 2 * margin);
    const double rough =
        roughness(fine, box & cv::Rect(0, 0, fine.cols, fine.rows), 1, [&](int x, int y) {
          const cv::Point at(x / side, y / side);
          const auto in = [&](int dx, int dy) {
            return labels.at<int>(at + cv::Point(dx, dy)) == piece.label;
          };
          return inner.contains(at) && in(margin, 0) && in(-margin, 0) && in(0, margin) &&
                 in(0, -margin);
        });
    blob.grain = std::sqrt(std::max(0.0, rough - noise) / 2);
    blob.is_cut = is_cut(piece.box, labels, piece.label, seen);
    blobs.push_back(std::move(blob));
  }
  std::stable_sort(blobs.begin(), blobs.end(),
                   [](const Blob& a, const Blob& b) { return a.radius_px > b.radius_px; });
  return blobs;
}

}  // namespace microswarm
