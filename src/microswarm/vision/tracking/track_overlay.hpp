// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deque>
#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

#include "microswarm/vision/tracking/video_tracker.hpp"

namespace microswarm {

/// Draws what was tracked over the pictures: a circle around each robot, the way it came, its
/// number where there is room, a scale bar, time and count.
class TrackOverlay {
 public:
  explicit TrackOverlay(double um_per_px) : um_per_px_(um_per_px) {}
  /// The frame in colours with its robots, `rows`. Valid until the next call.
  const Image& draw(const VideoFrame& frame, const std::vector<TrackRow>& rows);

 private:
  struct Trail {
    int last_frame = 0;
    std::deque<Vec2> places_px;
  };
  void follow(const std::vector<TrackRow>& rows, int frame, int height);

  double um_per_px_;
  std::vector<std::optional<Trail>> trails_;  ///< by id; nothing for robots long gone
  Image shown_;
};

/// Length of the scale bar of a picture that shows `width` [µm]: 1, 2 or 5 times a power of ten,
/// about a fifth of it.
double scale_bar_length(double width);

/// Pictures to a video file (MPEG-4) or, where there is no codec for it, to PNG files in a folder
/// beside it, of its name without extension. The file appears under its name on commit().
class VideoFileWriter {
 public:
  /// `rate` [1/s]. Throws InputError "PATH: cannot write: REASON".
  VideoFileWriter(std::filesystem::path file, double rate);
  ~VideoFileWriter();
  VideoFileWriter(const VideoFileWriter&) = delete;
  VideoFileWriter& operator=(const VideoFileWriter&) = delete;

  /// A picture in colours, all of one size.
  void add(const Image& picture);
  /// Ends the video; gives where it is: the file or the folder. Nothing when there was no picture.
  std::optional<std::filesystem::path> commit();

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace microswarm
