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
  double radius_um = 0;  ///< 0 without
  double signal = 0;
  double eccentricity = 0;
  std::optional<double> t{};  ///< time of its frame that the table gives [s]
  int line = 0;               ///< of the table, from 1; 0 without
};

/// Features or tracks of another program.
struct TrackTable {
  std::vector<TableRow> rows{};       ///< sorted by frame; all of them have an id or none
  std::optional<double> um_per_px{};  ///< as the file says
  std::optional<double> interval{};   ///< time between frames, as the file says [s]
  std::optional<int> height{};        ///< of the pictures, as the file says [px]
  std::size_t untracked = 0;          ///< features in no track, left out where others are in one
  std::vector<std::string> notes{};   ///< what was not read, a line each
};

/// Reads the table of another program: XML of TrackMate (parse_trackmate_xml) or CSV with a header,
/// in any order of columns.
/// - trackpy: frame, x, y [px]; particle if it is linked; mass, signal; ecc or eccentricity; t_s.
/// - TrackMate's export of spots: FRAME, POSITION_X, POSITION_Y, TRACK_ID, POSITION_T. The second
///   and third header line may repeat the names, a fourth gives units in parentheses. Without it
///   positions are in µm, of which a pixel has `um_per_px`, and times in s.
/// - tracks.csv of `microswarm track`: the same with x_um and y_um, from which come the scale and
///   the height of the pictures, and radius_um.
/// Blank lines are skipped. Columns may be quoted. Throws InputError "NAME:LINE: WHY", also if a
/// track has two positions in a frame, if a unit is not known, or if µm need a scale that is not
/// given, and if the file is no text or UTF-16.
TrackTable parse_track_table(std::string_view text, std::string_view name,
                             std::optional<double> um_per_px);
TrackTable read_track_table(const std::filesystem::path& path, std::optional<double> um_per_px);

/// Whether files of this name are tables: .csv, .tsv, .txt or .xml, or the standard input.
bool is_track_table(const std::filesystem::path& path);

/// Tracks of a table. Rows without ids are linked by RobotTracker with `settings`. Times are those
/// of the settings' rate, else of the table's rows, else by its interval, else a second a frame;
/// frames without a position lie evenly between those with one. The world's lower border is that of
/// the table's pictures, or of the lowest position's pixel, with a note. Throws
/// InputError for inconsistent settings, and with the line of `source` for times that are missing
/// or do not ascend.
TrackResult tracks_of_table(const TrackTable& table, const std::string& source,
                            const TrackSettings& settings);

}  // namespace microswarm::vision
