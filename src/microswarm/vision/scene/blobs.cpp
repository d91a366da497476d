// SPDX-License-Identifier: Apache-2.0
#include "microswarm/vision/scene/blobs.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <opencv2/imgproc.hpp>
#include <span>
#include <string>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/execution/each_cpu.hpp"
#include "microswarm/core/maths/magnitudes.hpp"
#include "microswarm/core/maths/maths.hpp"
#include "microswarm/vision/image/blur.hpp"
#include "microswarm/vision/image/mat.hpp"
#include "microswarm/vision/image/pixel_runs.hpp"
#include "microswarm/vision/scene/background.hpp"
#include "microswarm/vision/scene/blob_search.hpp"
#include "microswarm/vision/scene/level_line.hpp"

namespace microswarm::vision {
namespace {

constexpr int smooth_side = 5;     // working pixels that a smooth part must extend over
constexpr int ground_rows = 4;     // every so many rows are used for the background noise
constexpr double noise_limit = 5;  // spreads of the background; smaller differences are ignored

}  // namespace

int coarseness(const BlobParams& p) {
  const double fine = std::min(p.min_radius / 3, p.gap / 2);
  return fine >= 4 ? 4 : fine >= 2 ? 2 : 1;
}

cv::Mat downsampled(const cv::Mat& mat, int side) {
  if (side == 1) return mat;
  const int right = (side - mat.cols % side) % side;
  const int below = (side - mat.rows % side) % side;
  cv::Mat padded = mat;
  if (right + below > 0) cv::copyMakeBorder(mat, padded, 0, below, 0, right, cv::BORDER_REPLICATE);
  cv::Mat small;
  cv::resize(padded, small, {padded.cols / side, padded.rows / side}, 0, 0, cv::INTER_AREA);
  return small;
}

cv::Mat walls_over(const formats::Image& picture, const formats::Mask* walls) {
  if (!walls) return {};
  if (walls->width != picture.width || walls->height != picture.height)
    throw InputError("walls: " + std::to_string(walls->width) + "x" +
                     std::to_string(walls->height) + " pixels, the picture has " +
                     std::to_string(picture.width) + "x" + std::to_string(picture.height));
  return {walls->height, walls->width, CV_8U, const_cast<std::uint8_t*>(walls->cells.data())};
}

namespace {

/// Adds the pixels of a row that are set to those of the blocks in it.
MICROSWARM_EACH_CPU void mark(const std::uint8_t* row, std::uint8_t* marks, int count) {
  for (int x = 0; x < count; ++x) marks[x] |= row[x];
}

/// 255 for each block of `side` pixels of which any is set, else 0.
template <int side>
void mark_blocks(const std::uint8_t* marks, int count, std::uint8_t* out) {
  for (int x = 0; x < count; ++x) {
    std::uint8_t any = 0;
    for (int k = 0; k < side; ++k) any |= marks[side * x + k];
    out[x] = any != 0 ? 255 : 0;
  }
}

/// Blocks of `side` × `side` pixels, as of `coarseness`, of which any is not 0 (255).
cv::Mat any_of_blocks(const cv::Mat& set, int side) {
  const int columns = (set.cols + side - 1) / side;
  cv::Mat any((set.rows + side - 1) / side, columns, CV_8U);
  std::vector<std::uint8_t> marks(static_cast<std::size_t>(columns) * side);
  const auto mark_row = side == 4 ? mark_blocks<4> : side == 2 ? mark_blocks<2> : mark_blocks<1>;
  for (int y = 0; y < any.rows; ++y) {
    std::fill(marks.begin(), marks.end(), std::uint8_t{0});
    for (int row = side * y; row < std::min(side * (y + 1), set.rows); ++row)
      mark(set.ptr<std::uint8_t>(row), marks.data(), set.cols);
    mark_row(marks.data(), columns, any.ptr<std::uint8_t>(y));
  }
  return any;
}

}  // namespace

cv::Mat visible_pixels(const cv::Mat& walls, int side) {
  if (walls.empty()) return {};
  cv::Mat hidden;
  cv::dilate(any_of_blocks(walls, side), hidden, cv::Mat::ones(3, 3, CV_8U));
  return ~hidden;
}

namespace {

/// Replaces the background by the foreground where something is seen, everywhere without `seen`:
/// grey minus background, times `sign`.
MICROSWARM_EACH_CPU void take_ground(std::span<const std::uint8_t> grey, const std::uint8_t* seen,
                                     float sign, float* ground) {
  for (std::size_t i = 0; i < grey.size(); ++i) {
    const float foreground = sign * (static_cast<float>(grey[i]) - ground[i]);
    ground[i] = !seen || seen[i] ? foreground : 0.0F;
  }
}

/// Converts means over all pixels to means over the seen pixels.
MICROSWARM_EACH_CPU void make_up(std::span<const float> share, const std::uint8_t* seen,
                                 float* foreground) {
  for (std::size_t i = 0; i < share.size(); ++i) {
    const float mean = foreground[i] / (share[i] > 0.1F ? share[i] : 0.1F);
    foreground[i] = seen[i] ? mean : 0.0F;
  }
}

/// Blurred share of seen pixels; it is the same wherever nothing hidden is in reach.
cv::Mat blurred_share(const cv::Mat& seen, double spread, int reach) {
  cv::Mat share;
  seen.convertTo(share, CV_32F, 1.0 / 255);
  const cv::Mat one = cv::Mat::ones(1, 1, CV_32F);
  cv::Mat out(seen.size(), CV_32F,
              cv::Scalar(blurred(one, spread, reach, cv::BORDER_REFLECT).at<float>(0)));
  cv::Rect near = cv::boundingRect(~seen);
  if (near.empty()) return out;
  near -= cv::Point(reach, reach);
  near += cv::Size(2 * reach, 2 * reach);
  near &= cv::Rect({}, seen.size());
  blurred(share(near), spread, reach, cv::BORDER_REFLECT).copyTo(out(near));
  return out;
}

}  // namespace

cv::Mat subtract_background(const cv::Mat& grey, const cv::Mat& seen, cv::Mat foreground, bool dark,
                            double spread) {
  for (int y = 0; y < grey.rows; ++y)
    take_ground({grey.ptr<std::uint8_t>(y), static_cast<std::size_t>(grey.cols)},
                seen.empty() ? nullptr : seen.ptr<std::uint8_t>(y), dark ? -1 : 1,
                foreground.ptr<float>(y));
  const int reach = static_cast<int>(std::ceil(2.5 * spread));
  foreground = blurred(foreground, spread, reach, cv::BORDER_REFLECT);
  if (seen.empty()) return foreground;
  const cv::Mat share = blurred_share(seen, spread, reach);
  make_up({share.ptr<float>(), share.total()}, seen.ptr<std::uint8_t>(), foreground.ptr<float>());
  return foreground;
}

double ground_spread(const cv::Mat& foreground, const cv::Mat& seen) {
  constexpr std::size_t enough = 10'000;
  const std::size_t step = 2 * (foreground.total() / enough / 2) + 7;  // odd, so that columns vary
  const std::size_t total = foreground.total();
  const float* rises = foreground.ptr<float>();
  const std::uint8_t* shown = seen.empty() ? nullptr : seen.ptr<std::uint8_t>();
  std::vector<double> off;
  off.reserve(total / step + 1);
  for (std::size_t i = 0; i < total; i += step)
    if (!shown || shown[i]) off.push_back(std::abs(rises[i]));
  return 1.4826 * median_of_magnitudes(off);
}

namespace {

/// A connected set of working pixels.
struct Piece {
  cv::Rect box;
  cv::Mat in;  ///< mask of the piece over the box, 255 inside

  cv::Point first() const {
    cv::Point at = box.tl();
    while (!in.at<std::uint8_t>(at - box.tl())) ++at.x;
    return at;
  }
};

/// Connected pieces of at least `min_area` pixels; `corner` is the position of the set's first
/// pixel.
std::vector<Piece> find_pieces(const cv::Mat& set, cv::Point corner, double min_area) {
  std::vector<Piece> pieces;
  for (const RunPiece& found : connected_runs(set)) {
    if (found.area < min_area) continue;
    cv::Mat in = cv::Mat::zeros(found.box.size(), CV_8U);
    for (const PixelRun& run : found.runs)
      std::fill(in.ptr<std::uint8_t>(run.row - found.box.y) + (run.begin - found.box.x),
                in.ptr<std::uint8_t>(run.row - found.box.y) + (run.end - found.box.x),
                std::uint8_t{255});
    pieces.push_back({found.box + corner, in});
  }
  return pieces;
}

/// The piece is of what rises, so its values are positive.
float median_within(const cv::Mat& foreground, const Piece& piece) {
  std::vector<double> values;
  values.reserve(piece.in.total());
  for (int y = 0; y < piece.box.height; ++y) {
    const auto* in = piece.in.ptr<std::uint8_t>(y);
    const auto* row = foreground.ptr<float>(piece.box.y + y) + piece.box.x;
    for (int x = 0; x < piece.box.width; ++x)
      if (in[x]) values.push_back(row[x]);
  }
  return static_cast<float>(median_of_magnitudes(values));
}

/// Measures area, centroid and ellipse of the region inside the outline; false if the area is zero.
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
  const double spread = norm({half, mixed});
  blob.semi_major_px = 2 * std::sqrt(mean + spread);
  blob.semi_minor_px = 2 * std::sqrt(std::max(0.0, mean - spread));
  blob.angle = 0.5 * maths::atan2(mixed, half);
  return true;
}

bool is_cut(const Piece& piece, const cv::Mat& seen, const cv::Size& size) {
  const cv::Rect inner(1, 1, size.width - 2, size.height - 2);
  if ((piece.box & inner) != piece.box) return true;
  if (seen.empty()) return false;
  const cv::Rect around = piece.box + cv::Size(2, 2) - cv::Point(1, 1);
  cv::Mat grown;
  cv::copyMakeBorder(piece.in, grown, 1, 1, 1, 1, cv::BORDER_CONSTANT);
  cv::dilate(grown, grown, cv::Mat::ones(3, 3, CV_8U));
  return cv::countNonZero(grown & ~seen(around)) > 0;
}

/// Expected absolute difference of neighbours for a texture of this spread plus noise of this
/// roughness.
double mean_step(double noise, double texture) {
  return std::sqrt((noise + 2 * texture * texture) * 2 / std::numbers::pi);
}

/// The parts of a piece that are smooth over more than `smooth_side` working pixels. The texture of
/// a pixel is a median over its surroundings, so the edge of a smooth object does not count as
/// texture.
cv::Mat smooth_parts(const BlobContext& field, const Piece& piece, double least) {
  const int side = field.side;
  const cv::Rect all(0, 0, field.fine.cols, field.fine.rows);
  const cv::Mat fine = field.fine(cv::Rect(side * piece.box.tl(), side * piece.box.br()) & all);
  cv::Mat steps;  // mean of the differences to the neighbours on the right and below
  cv::Mat next;
  cv::copyMakeBorder(fine, next, 0, 1, 0, 1, cv::BORDER_REPLICATE);
  const cv::Rect same(0, 0, fine.cols, fine.rows);
  cv::Mat right;
  cv::Mat below;
  cv::absdiff(fine, next(same + cv::Point(1, 0)), right);
  cv::absdiff(fine, next(same + cv::Point(0, 1)), below);
  cv::addWeighted(right, 0.5, below, 0.5, 0, steps);
  steps = downsampled(steps, side);
  cv::medianBlur(steps, steps, 5);
  cv::Mat smooth = piece.in & (steps <= least);
  cv::Mat core;
  const cv::Mat square = cv::Mat::ones(smooth_side, smooth_side, CV_8U);
  cv::erode(smooth, core, square, {-1, -1}, 1, cv::BORDER_CONSTANT, 0);
  cv::dilate(core, core, cv::Mat::ones(smooth_side + 4, smooth_side + 4, CV_8U));
  return core & smooth;
}

/// The contour of a piece at `level` in working pixels. What is as high beside the piece but was
/// cut off from it counts as background.
std::vector<Vec2> piece_outline(const cv::Mat& foreground, const Piece& piece, float level) {
  const cv::Rect all(0, 0, foreground.cols, foreground.rows);
  const cv::Rect around = (piece.box + cv::Size(2, 2) - cv::Point(1, 1)) & all;
  cv::Mat own = foreground(around).clone();
  cv::Mat others = cv::Mat::ones(around.size(), CV_8U);
  others(piece.box - around.tl()).setTo(0, piece.in);
  own.setTo(0, others & (own > level));
  std::vector<Vec2> line = level_line(own, level, piece.first() - around.tl());
  for (Vec2& q : line) q += Vec2{1.0 * around.x, 1.0 * around.y};
  return line;
}

/// Blob of a piece with its outline at `level`; `noise` is the roughness of the background.
std::optional<Blob> measure_blob(const BlobContext& field, const Piece& piece, float level,
                                 double noise) {
  Blob blob;
  blob.outline_px = piece_outline(field.foreground, piece, level);
  for (Vec2& q : blob.outline_px) q = field.side * q + 0.5 * (field.side - 1) * Vec2{1, 1};
  if (!measure(blob)) return std::nullopt;
  blob.contrast = median_within(field.foreground, piece);
  cv::Mat inner;  // exclude the edge from the texture
  cv::erode(piece.in, inner, cv::Mat::ones(5, 5, CV_8U), {-1, -1}, 1, cv::BORDER_CONSTANT, 0);
  blob.texture = std::sqrt(std::max(0.0, roughness(field, piece.box, inner, 1) - noise) / 2);
  blob.is_cut = is_cut(piece, field.seen, field.foreground.size());
  return blob;
}

}  // namespace

Issues validate(const BlobParams& p) {
  Issues issues;
  if (p.max_radius < p.min_radius)
    issues.add({"max_radius_px", "min_radius_px"},
               fmt::format("max_radius_px is {:.6g}, min_radius_px {:.6g}: nothing is found",
                           p.max_radius, p.min_radius));
  return issues;
}

float min_foreground(const BlobParams& p, double spread) {
  return static_cast<float>(std::max(p.min_contrast, noise_limit * spread));
}

namespace {

/// The largest part of a piece that reaches half of its contrast.
std::optional<Blob> main_blob(const BlobContext& field, const Piece& piece, float least,
                              double noise, double smallest) {
  const float level = std::max(least, median_within(field.foreground, piece) / 2);
  const cv::Mat half_up = piece.in & (field.foreground(piece.box) > level);
  const std::vector<Piece> parts = find_pieces(half_up, piece.box.tl(), smallest);
  const auto largest = std::max_element(parts.begin(), parts.end(), [](auto& a, auto& b) {
    return cv::countNonZero(a.in) < cv::countNonZero(b.in);
  });
  return largest == parts.end() ? std::nullopt : measure_blob(field, *largest, level, noise);
}

}  // namespace

// Thresholds the foreground, then keeps of each piece what reaches half the contrast of its middle.
void add_blobs(const BlobContext& field, const BlobParams& p, float least, double noise,
               std::vector<Blob>& blobs, std::vector<Blob>* refused) {
  const double min_area = std::numbers::pi * maths::power(0.5 * p.min_radius / field.side, 2);
  const double smallest = refused ? min_area / 4 : min_area;
  const auto refuse = [&](std::optional<Blob> blob) {
    if (blob && refused) refused->push_back(std::move(*blob));
  };
  for (Piece& piece : find_pieces(field.foreground > least, {}, smallest)) {
    std::optional<Blob> whole;  // with its smooth part, which is then all that is refused
    std::optional<Blob> smooth_blob;
    if (p.min_texture > 0) {
      const cv::Mat smooth = smooth_parts(field, piece, mean_step(noise, p.min_texture));
      if (refused && cv::countNonZero(smooth) >= min_area) {
        whole = main_blob(field, piece, least, noise, smallest);
        smooth_blob = main_blob(field, {piece.box, smooth}, least, noise, smallest);
      }
      piece.in &= ~smooth;
      field.foreground(piece.box).setTo(0, smooth);
      if (cv::countNonZero(piece.in) < min_area) {
        refuse(whole);
        continue;
      }
    }
    const std::size_t before = blobs.size();
    const float level = std::max(least, median_within(field.foreground, piece) / 2);
    const cv::Mat half_up = piece.in & (field.foreground(piece.box) > level);
    for (const Piece& part : find_pieces(half_up, piece.box.tl(), smallest)) {
      std::optional<Blob> blob = measure_blob(field, part, level, noise);
      if (blob && cv::countNonZero(part.in) >= min_area && blob->radius_px >= p.min_radius &&
          blob->radius_px <= p.max_radius && blob->texture >= p.min_texture)
        blobs.push_back(std::move(*blob));
      else if (!whole)
        refuse(std::move(blob));
    }
    if (whole) refuse(blobs.size() == before ? whole : smooth_blob);
  }
}

void sort_by_size(std::vector<Blob>& blobs) {
  std::stable_sort(blobs.begin(), blobs.end(),
                   [](const Blob& a, const Blob& b) { return a.radius_px > b.radius_px; });
}

namespace {

/// `grey` has one channel and must outlive the result.
BlobContext make_context(const formats::Image& grey, const BlobParams& p,
                         const formats::Mask* walls) {
  BlobContext field{.side = coarseness(p)};
  field.seen = visible_pixels(walls_over(grey, walls), field.side);
  field.fine = as_mat(grey);
  const cv::Mat coarse = downsampled(field.fine, field.side);
  field.foreground =
      subtract_background(coarse, field.seen, estimate_background(coarse, field.seen),
                          p.tone == ParticleTone::dark, p.gap / 2 / field.side);
  return field;
}

float min_foreground(const BlobContext& field, const BlobParams& p) {
  return min_foreground(p, ground_spread(field.foreground, field.seen));
}

}  // namespace

double contrast_limit(const formats::Image& picture, const BlobParams& params,
                      const formats::Mask* walls) {
  if (picture.pixels.empty()) return params.min_contrast;
  const formats::Image one = picture.channels == 1 ? formats::Image{} : formats::to_grey(picture);
  return min_foreground(make_context(picture.channels == 1 ? picture : one, params, walls), params);
}

std::vector<Blob> find_blobs(const formats::Image& picture, const BlobParams& p,
                             const formats::Mask* walls, std::vector<Blob>* refused) {
  walls_over(picture, walls);  // for its check
  if (picture.pixels.empty()) return {};
  const formats::Image one = picture.channels == 1 ? formats::Image{} : formats::to_grey(picture);
  const BlobContext field = make_context(picture.channels == 1 ? picture : one, p, walls);
  const float least = min_foreground(field, p);
  const cv::Mat high = field.foreground > least;
  const cv::Mat ground = field.seen.empty() ? cv::Mat(~high) : cv::Mat(~high & field.seen);
  const double noise = roughness(field, {0, 0, ground.cols, ground.rows}, ground, ground_rows);
  std::vector<Blob> blobs;
  add_blobs(field, p, least, noise, blobs, refused);
  sort_by_size(blobs);
  return blobs;
}

}  // namespace microswarm::vision
