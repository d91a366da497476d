// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "microswarm/vision/tracking/video_tracker.hpp"

namespace microswarm::cli {

/// Result of tracking a video.
struct TrackResult {
  std::string source;
  TrackSettings settings;
  double frame_time = 1;  ///< [s]
  int frames = 0;
  std::optional<int> promised;  ///< number of frames stated by the video
  std::vector<TrackRow> rows;
  std::vector<TrackEvent> events;
};

/// Writes tracks.csv, events.csv and tracks.h5 into the folder. tracks.csv can be read as recorded
/// tracks of maps and obstacles. Throws InputError "FILE: cannot write: REASON".
void write_tracks(const TrackResult& result, const std::filesystem::path& folder);

/// Throws InputError if a file to be written is the input.
void keep_track_input(const std::filesystem::path& folder, const std::string& input);

nlohmann::ordered_json to_json(const TrackResult& result);
/// A summary of a few lines.
std::string track_summary(const TrackResult& result);

}  // namespace microswarm::cli
