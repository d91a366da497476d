// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "microswarm/vision/tracking/video_tracker.hpp"

namespace microswarm::cli {

/// What was tracked in a video.
struct TrackResult {
  std::string source;
  TrackSettings settings;
  double frame_time = 1;  ///< [s]
  int frames = 0;
  std::optional<int> promised;  ///< frames that the video says it has
  std::vector<TrackRow> rows;
  std::vector<TrackEvent> events;
};

/// Writes tracks.csv, events.csv and tracks.h5 into the folder. tracks.csv is what maps and
/// obstacles read as recorded tracks. Throws InputError "FILE: cannot write: REASON".
void write_tracks(const TrackResult& result, const std::filesystem::path& folder);

/// Throws InputError when one of the files to be written is what is read.
void keep_track_input(const std::filesystem::path& folder, const std::string& input);

nlohmann::ordered_json to_json(const TrackResult& result);
/// A few lines for people.
std::string track_summary(const TrackResult& result);

}  // namespace microswarm::cli
