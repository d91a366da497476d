// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "microswarm/vision/tracking/video_tracks.hpp"

namespace microswarm::cli {

/// Writes tracks.csv, events.csv and tracks.h5 into the folder. tracks.csv can be read as recorded
/// tracks of maps and obstacles. Throws InputError "FILE: cannot write: REASON".
void write_tracks(const vision::TrackResult& result, const std::filesystem::path& folder);

/// Throws InputError if a file to be written is the input.
void keep_track_input(const std::filesystem::path& folder, const std::string& input);

/// Result for --json.
nlohmann::ordered_json tracks_json(const vision::TrackResult& result);
/// A row of summary.csv, on one video of several.
struct VideoRow {
  std::string video;
  std::string folder;
  std::string error{};  ///< empty if it was tracked
  int frames = 0;
  vision::TrackSummary summary{};
  int unsettled = 0;
  void take(const vision::TrackResult& result);
};
std::string summary_csv(const std::vector<VideoRow>& rows);

/// Summary in a few lines.
std::string track_summary(const vision::TrackResult& result);

}  // namespace microswarm::cli
