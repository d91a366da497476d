// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deque>
#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

#include "microswarm/vision/tracking/video_tracker.hpp"

namespace microswarm::vision {

/// Sides of a picture [px].
struct PictureSize {
  int width = 0;
  int height = 0;
  bool operator==(const PictureSize&) const = default;
};

/// Draws tracks over the pictures: a circle around each robot, its trail, its number where there is
/// room, a scale bar, time and count.
class TrackOverlay {
 public:
  /// Pictures with more pixels are shrunk: an encoder holds several of them in memory.
  static constexpr int max_pixels = 2048 * 2048;
  /// Size in the overlay of pictures that are so large.
  static PictureSize size(PictureSize of_pictures);

  explicit TrackOverlay(double um_per_px) : um_per_px_(um_per_px) {}
  /// The frame in colour with its robots `rows`, as large as size() says. Valid until the next
  /// call.
  const formats::Image& draw(const VideoFrame& frame, const std::vector<TrackRow>& rows);

 private:
  struct Trail {
    int last_frame = 0;
    std::deque<Vec2> places_px;
  };
  void follow(const std::vector<TrackRow>& rows, int frame, int height, double um_per_px);

  double um_per_px_;
  std::vector<std::optional<Trail>> trails_;  ///< by id; empty for robots not seen for long
  formats::Image shown_;
};

/// Length of the scale bar for a picture `width` [µm] wide: 1, 2 or 5 times a power of ten, about a
/// fifth of the width.
double scale_bar_length(double width);

}  // namespace microswarm::vision
