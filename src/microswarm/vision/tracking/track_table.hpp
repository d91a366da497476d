// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "microswarm/vision/tracking/video_tracks.hpp"

namespace microswarm::vision {

/// A position of a table of features or tracks.
struct TableRow {
  int frame = 0;
  std::optional<int> id{};  ///< of its track
  Vec2 at_px{};             ///< y down, (0, 0) is the centre of the first pixel
  double mass = 0;
};

/// Reads the table of another program: CSV with a header, in any order of columns.
/// - trackpy: frame, x, y [px]; particle if it is linked; mass.
/// - TrackMate's export of spots: FRAME, POSITION_X, POSITION_Y, TRACK_ID. The second and third
///   header line may repeat the names, a fourth gives units in parentheses: positions are in px
///   if it says (pixel), else in µm, of which a pixel has `um_per_px`.
/// - tracks.csv of `microswarm track`.
/// Blank lines are skipped. Columns may be quoted. Rows come sorted by frame; all of them have an
/// id or none. Throws InputError "NAME:LINE: WHY", also if a track has two positions in a frame.
std::vector<TableRow> parse_track_table(std::string_view text, std::string_view name,
                                        double um_per_px);
std::vector<TableRow> read_track_table(const std::filesystem::path& path, double um_per_px);

/// Tracks of a table. Rows without ids are linked by RobotTracker with `settings`. The world's
/// lower border is that of the lowest position's pixel. Throws InputError for inconsistent
/// settings.
TrackResult tracks_of_table(const std::vector<TableRow>& table, const std::string& source,
                            const TrackSettings& settings);

}  // namespace microswarm::vision
