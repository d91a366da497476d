// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "microswarm/core/execution/stop.hpp"
#include "microswarm/vision/tracking/video_tracker.hpp"

namespace microswarm::vision {

/// Result of tracking a video.
struct TrackResult {
  std::string source{};
  TrackSettings settings{};
  double frame_time = 1;  ///< mean [s]
  int frames = 0;
  int unsettled = 0;                 ///< robots whose centres did not settle
  int wider = 0;                     ///< robots wider than the diameter that was given
  int crowded = 0;                   ///< robots left out, since another is too close
  std::optional<int> promised{};     ///< number of frames stated by the video
  std::vector<double> times{};       ///< of each picture [s]
  std::vector<std::string> notes{};  ///< assumptions in reading, doubts about positions
  std::vector<TrackRow> rows{};
  std::vector<TrackEvent> events{};
};

/// Sets each velocity from the robot's positions in the picture before and the one after (central
/// difference), at the ends of a track from one of them; 0 for a track of one picture. `rows` are
/// sorted by frame.
void take_velocities(std::vector<TrackRow>& rows);

/// Receives each picture and the robots seen in it.
using OnTracked = std::function<void(const VideoFrame&, const std::vector<TrackRow>&)>;

/// Tracks picture by picture to the end of `frames`, or until `stop`. A source without a rate
/// has one picture a second; settings without a scale have that of the source. `source` is its name
/// in the result. Throws InputError for inconsistent settings, and like FrameSource::next.
TrackResult track_video(FrameSource& frames, const std::string& source,
                        const TrackSettings& settings, const OnTracked& on_tracked,
                        const Stop& stop = {});

}  // namespace microswarm::vision
