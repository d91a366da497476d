// SPDX-License-Identifier: Apache-2.0
#include "microswarm/vision/scene/scene_windows.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "microswarm/vision/image/mat.hpp"
#include "microswarm/vision/image/pixel_runs.hpp"
#include "microswarm/vision/scene/background.hpp"
#include "microswarm/vision/scene/blob_search.hpp"
#include "microswarm/vision/scene/scene_parts.hpp"

namespace microswarm::vision {
namespace {

constexpr int coarse = 4;             // [px] side of a coarse pixel
constexpr int strips = 8;             // rows in which the background is measured
constexpr double coarse_share = 0.5;  // of the least difference, which makes a window
constexpr int max_windows = 200;      // more are one: the picture
constexpr double blur_reach = 2.5;    // standard deviations of the blur of `subtract_background`

/// Distance at which a window's edge has no influence on what is in it [px].
int window_margin(const BlobParams& p) {
  return static_cast<int>(std::ceil((0.5 * blur_reach + 1) * p.gap)) + 2 * coarse;
}

/// A box around a piece of what differs from the light.
struct Window {
  cv::Rect box;   ///< [px]
  int piece = 0;  ///< its number; 0 if everything in the box counts
};

bool meets(const cv::Rect& box, Vec2 centre, double radius) {
  const double x = std::clamp(centre.x, box.x - 0.5, box.br().x - 0.5);
  const double y = std::clamp(centre.y, box.y - 0.5, box.br().y - 0.5);
  return distance(centre, Vec2{x, y}) <= radius;
}

/// Whether a part of the outline is at an edge of its window that is not one of the picture.
bool leaves(const Blob& blob, const cv::Rect& window, const cv::Size& picture, double step) {
  return std::any_of(blob.outline_px.begin(), blob.outline_px.end(), [&](Vec2 p) {
    return (window.x > 0 && p.x < window.x + step) || (window.y > 0 && p.y < window.y + step) ||
           (window.br().x < picture.width && p.x > window.br().x - 1 - step) ||
           (window.br().y < picture.height && p.y > window.br().y - 1 - step);
  });
}

/// Background of a look: what counts as a difference, and the roughness.
struct Backdrop {
  float least = 0;
  double noise = 0;
};

/// The search of one picture.
class WindowSearch {
 public:
  WindowSearch(const formats::Image& picture, const formats::Mask* walls,
               const formats::Mask& coarse_walls, const SceneParams& params)
      : picture_(picture), walls_(walls), fine_(as_mat(picture)) {
    if (walls) coarse_seen_ = ~to_mat(coarse_walls);
    look_coarsely(params);
    place_windows(params);
  }

  /// Around all that differs from the light.
  const std::vector<Window>& windows() const { return windows_; }
  std::vector<Blob> search(const BlobParams& look, const formats::Mask* hidden,
                           const std::vector<Window>& windows) const;

 private:
  void look_coarsely(const SceneParams& params);
  void place_windows(const SceneParams& params);
  std::optional<std::vector<Blob>> search_within(const BlobParams& look,
                                                 const formats::Mask* hidden,
                                                 const std::vector<Window>& windows) const;
  Backdrop backdrop(const BlobParams& look) const;
  cv::Mat ground(const cv::Rect& box, int side) const;
  int piece_at(Vec2 at_px) const {
    return pieces_.at<int>(std::clamp(static_cast<int>(at_px.y) / coarse, 0, pieces_.rows - 1),
                           std::clamp(static_cast<int>(at_px.x) / coarse, 0, pieces_.cols - 1));
  }

  const formats::Image& picture_;
  const formats::Mask* walls_;
  cv::Mat fine_;
  cv::Mat coarse_seen_;
  std::optional<GroundSurface> light_;
  cv::Mat differs_;  // coarse pixels, 255 where a window is needed
  cv::Mat pieces_;   // coarse pixels, numbers of the pieces with their margins
  std::vector<Window> windows_;
};

/// Fits the light, and finds the coarse pixels that differ from it.
void WindowSearch::look_coarsely(const SceneParams& params) {
  const cv::Mat grey = downsampled(fine_, coarse);
  light_.emplace(grey, coarse_seen_);
  const cv::Mat light = light_->over({.size = grey.size()});
  cv::Mat off;
  cv::subtract(grey, light, off, coarse_seen_.empty() ? cv::noArray() : coarse_seen_, CV_32F);
  if (!coarse_seen_.empty()) off.setTo(0, ~coarse_seen_);
  const double spread = ground_spread(off, coarse_seen_);
  differs_ = cv::Mat::zeros(grey.size(), CV_8U);
  for (const BlobParams& look : {params.swarm.look, params.obstacles}) {
    const double least = coarse_share * min_foreground(look, spread);
    differs_ |= look.tone == ParticleTone::dark ? off < -least : off > least;
  }
}

/// Boxes around what differs, with the margin that the searches need.
void WindowSearch::place_windows(const SceneParams& params) {
  const int margin = std::max(window_margin(params.swarm.look), window_margin(params.obstacles));
  const int wide = 2 * (margin / coarse + 1) + 1;
  cv::Mat grown;
  cv::dilate(differs_, grown, cv::Mat::ones(wide, wide, CV_8U));
  const std::vector<RunPiece> found = connected_runs(grown);
  const cv::Rect all(0, 0, fine_.cols, fine_.rows);
  windows_.clear();
  if (std::ssize(found) >= max_windows) {
    windows_ = {{.box = all}};
    return;
  }
  pieces_ = cv::Mat::zeros(grown.size(), CV_32S);
  windows_.reserve(found.size());
  for (const RunPiece& one : found) {
    const int number = static_cast<int>(windows_.size()) + 1;
    for (const PixelRun& run : one.runs)
      std::fill(pieces_.ptr<int>(run.row) + run.begin, pieces_.ptr<int>(run.row) + run.end, number);
    const cv::Rect box(one.box.x * coarse, one.box.y * coarse, one.box.width * coarse,
                       one.box.height * coarse);
    windows_.push_back({.box = box & all, .piece = number});
  }
}

/// Blobs in the windows; of the whole picture if a blob continues beyond its window.
std::vector<Blob> WindowSearch::search(const BlobParams& look, const formats::Mask* hidden,
                                       const std::vector<Window>& windows) const {
  std::optional<std::vector<Blob>> blobs = search_within(look, hidden, windows);
  if (!blobs) blobs = search_within(look, hidden, {{.box = {0, 0, fine_.cols, fine_.rows}}});
  sort_by_size(*blobs);
  return std::move(*blobs);
}

std::optional<std::vector<Blob>> WindowSearch::search_within(
    const BlobParams& look, const formats::Mask* hidden, const std::vector<Window>& windows) const {
  const int side = coarseness(look);
  const Backdrop behind = backdrop(look);
  const cv::Mat walls = walls_over(picture_, hidden);
  std::vector<Blob> all;
  for (const auto& [window, piece] : windows) {
    BlobContext field{.side = side};
    field.fine = fine_(window);
    field.seen = walls.empty() ? cv::Mat() : visible_pixels(walls(window), side);
    const cv::Mat grey = downsampled(field.fine, side);
    field.foreground = subtract_background(grey, field.seen, ground(window, side),
                                           look.tone == ParticleTone::dark, look.gap / 2 / side);
    std::vector<Blob> blobs;
    add_blobs(field, look, behind.least, behind.noise, blobs);
    for (Blob& blob : blobs) {
      const Vec2 corner{1.0 * window.x, 1.0 * window.y};
      blob.centre_px += corner;
      for (Vec2& p : blob.outline_px) p += corner;
      if (piece != 0 && piece != piece_at(blob.outline_px[0])) continue;
      if (leaves(blob, window, fine_.size(), side)) return std::nullopt;
      all.push_back(std::move(blob));
    }
  }
  return all;
}

/// Measured in strips across the picture, of which the middle working row counts.
Backdrop WindowSearch::backdrop(const BlobParams& look) const {
  const int side = coarseness(look);
  const double spread = look.gap / 2 / side;
  const int reach = static_cast<int>(std::ceil(blur_reach * spread));
  const int high = std::min(fine_.rows, side * (2 * reach + 1));
  const cv::Mat cells = walls_over(picture_, walls_);
  std::vector<cv::Mat> rises, seens, fines;
  for (int k = 0; k < strips; ++k) {
    const int top = (fine_.rows - high) * (2 * k + 1) / (2 * strips) / coarse * coarse;
    const cv::Rect box(0, top, fine_.cols, high);
    const cv::Mat shown = cells.empty() ? cv::Mat() : visible_pixels(cells(box), side);
    const cv::Mat rise =
        subtract_background(downsampled(fine_(box), side), shown, ground(box, side),
                            look.tone == ParticleTone::dark, spread);
    const int middle = rise.rows / 2;
    rises.push_back(rise.row(middle));
    seens.push_back(shown.empty() ? cv::Mat(1, rise.cols, CV_8U, cv::Scalar(255))
                                  : shown.row(middle));
    const int below = std::min(side * middle, high - 1);
    for (int i = 0; i < side; ++i) fines.push_back(fine_(box).row(below));
  }
  BlobContext field{.side = side};
  cv::vconcat(rises, field.foreground);
  cv::vconcat(seens, field.seen);
  cv::vconcat(fines, field.fine);
  const float least = min_foreground(look, ground_spread(field.foreground, field.seen));
  const cv::Mat behind = ~(field.foreground > least) & field.seen;
  return {least, roughness(field, {0, 0, behind.cols, behind.rows}, behind, 1)};
}

cv::Mat WindowSearch::ground(const cv::Rect& box, int side) const {
  const double first = 0.5 * (side - coarse);  // from the middle of a coarse pixel's first
  return light_->over({.x = (box.x + first) / coarse,
                       .y = (box.y + first) / coarse,
                       .step = static_cast<double>(side) / coarse,
                       .size = {(box.width + side - 1) / side, (box.height + side - 1) / side}});
}

}  // namespace

SceneWindows::SceneWindows(formats::Mask walls) : walls_(std::move(walls)) {
  if (walls_.cells.empty()) return;
  const cv::Mat cells(walls_.height, walls_.width, CV_8U, walls_.cells.data());
  coarse_walls_ = to_mask(~visible_pixels(cells, coarse));
}

SeenScene SceneWindows::find(const formats::Image& picture, const SceneParams& params,
                             const SwarmPrior& prior, std::span<const Ring> expected) {
  const formats::Mask* walls = walls_.cells.empty() ? nullptr : &walls_;
  walls_over(picture, walls);  // for its check
  if (picture.pixels.empty()) return {};
  const WindowSearch in(picture, walls, coarse_walls_, params);
  const std::optional<Vec2> before_px = prior.at_px;
  const double around = std::max(params.swarm.jump, prior.around_px);
  std::vector<Window> near, far;
  for (const Window& window : in.windows())
    (!before_px || meets(window.box, *before_px, around) ? near : far).push_back(window);
  SeenScene scene;
  scene.swarm = choose_swarm(in.search(params.swarm.look, walls, near), params.swarm, before_px);
  if (scene.swarm.sight == SwarmSight::none && !far.empty())
    scene.swarm = choose_swarm(in.search(params.swarm.look, walls, far), params.swarm, before_px);
  if (scene.swarm.sight == SwarmSight::none && looks_for_smooth(params))
    scene.swarm = choose_smooth(in.search(smooth_look(params), walls, in.windows()), params, prior);
  formats::Mask hidden;
  if (scene.swarm.swarm) {
    hidden = hidden_by(*scene.swarm.swarm, picture, walls, params.swarm.look.gap);
    walls = &hidden;
  }
  scene.obstacles = to_obstacles(in.search(params.obstacles, walls, in.windows()),
                                 {picture.width, picture.height}, walls, params, expected);
  return scene;
}

}  // namespace microswarm::vision
