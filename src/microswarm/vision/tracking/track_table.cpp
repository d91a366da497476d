// SPDX-License-Identifier: Apache-2.0
#include "microswarm/vision/tracking/track_table.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <span>
#include <utility>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/text/csv.hpp"
#include "microswarm/core/text/file.hpp"
#include "microswarm/core/text/lines.hpp"
#include "microswarm/core/text/text.hpp"

namespace microswarm::vision {
namespace {

constexpr std::uint64_t max_table_bytes = 512ULL << 20;
constexpr double max_frame = 1e7;
constexpr double max_table_id = 1e6;
constexpr double max_position = 1e7;

enum TableColumn : std::size_t {
  frame_column,
  x_column,
  y_column,
  id_column,
  mass_column,
  columns
};

/// Names of the columns in the tables of one program; the first three are needed.
struct TableForm {
  std::array<std::string_view, columns> names;
  bool is_trackmate = false;
};
constexpr std::array<TableForm, 2> table_forms{
    {{{"frame", "x", "y", "particle", "mass"}},
     {{"FRAME", "POSITION_X", "POSITION_Y", "TRACK_ID", ""}, true}}};

/// Positions of the columns in a table.
struct TableHeader {
  TableForm form;
  std::array<std::optional<std::size_t>, columns> at;
  std::size_t count = 0;
  char separator = ',';
};

TableHeader find_header(const Lines& lines, std::string_view line) {
  const char separator = csv_separator(line);
  const std::vector<std::string_view> names = csv_cells(line, separator);
  for (const TableForm& form : table_forms) {
    TableHeader header{.form = form, .at = {}, .count = names.size(), .separator = separator};
    for (std::size_t c = 0; c < columns; ++c) {
      const auto found = std::find(names.begin(), names.end(), form.names[c]);
      if (found == names.end() || form.names[c].empty()) continue;
      if (std::find(found + 1, names.end(), form.names[c]) != names.end())
        lines.fail("column '" + std::string(form.names[c]) + "' stands twice");
      header.at[c] = static_cast<std::size_t>(found - names.begin());
    }
    if (header.at[frame_column] && header.at[x_column] && header.at[y_column]) return header;
  }
  lines.fail("columns frame, x, y (trackpy) or FRAME, POSITION_X, POSITION_Y (TrackMate) expected");
}

double table_number(const Lines& lines, std::string_view word, std::string_view what, double least,
                    double most) {
  const std::optional<double> value = parse_number(word);
  if (!value) lines.fail(std::string(what) + " " + quote(word) + " is no number");
  if (!(*value >= least && *value <= most))
    lines.fail(std::string(what) + " is " + number_text(*value) + ", must be " +
               number_text(least) + " to " + number_text(most));
  return *value;
}

int table_whole(const Lines& lines, std::string_view word, std::string_view what, double most) {
  const double value = table_number(lines, word, what, 0, most);
  if (value != std::floor(value))
    lines.fail(std::string(what) + " is " + number_text(value) + ", must be a whole number");
  return static_cast<int>(value);
}

void sort_and_check(std::vector<TableRow>& rows, std::string_view name) {
  std::stable_sort(rows.begin(), rows.end(),
                   [](const TableRow& a, const TableRow& b) { return a.frame < b.frame; });
  std::set<int> ids;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (i > 0 && rows[i].frame != rows[i - 1].frame) ids.clear();
    if (rows[i].id && !ids.insert(*rows[i].id).second)
      throw InputError(std::string(name) + ": track " + std::to_string(*rows[i].id) +
                       " has two positions in frame " + std::to_string(rows[i].frame));
  }
}

}  // namespace

std::vector<TableRow> parse_track_table(std::string_view text, std::string_view name,
                                        double um_per_px) {
  Lines lines(text, name);
  std::optional<TableHeader> header;
  std::vector<TableRow> rows;
  double per_px = 1;
  while (const std::optional<std::string_view> line = lines.next()) {
    if (trimmed(*line).empty()) continue;
    if (!header) {
      header = find_header(lines, *line);
      per_px = header->form.is_trackmate ? um_per_px : 1;
      continue;
    }
    const std::vector<std::string_view> fields = csv_cells(*line, header->separator);
    if (fields.size() != header->count)
      lines.fail(std::to_string(fields.size()) + " fields, the header has " +
                 std::to_string(header->count));
    const auto field = [&](TableColumn c) {
      return csv_number(fields[*header->at[c]], header->separator);
    };
    const auto column_name = [&](TableColumn c) { return header->form.names[c]; };
    if (header->form.is_trackmate && rows.empty() && !parse_number(field(x_column))) {
      if (field(x_column).find("pixel") != std::string_view::npos) per_px = 1;
      continue;  // further lines of the header
    }
    TableRow row{.frame =
                     table_whole(lines, field(frame_column), column_name(frame_column), max_frame)};
    const auto place = [&](TableColumn c) {
      return table_number(lines, field(c), column_name(c), -max_position, max_position) / per_px;
    };
    row.at_px = {place(x_column), place(y_column)};
    if (header->at[id_column] && !field(id_column).empty() && field(id_column) != "None")
      row.id = table_whole(lines, field(id_column), column_name(id_column), max_table_id);
    else if (header->at[id_column])
      continue;  // a feature that is in no track
    if (header->at[mass_column])
      row.mass = table_number(lines, field(mass_column), column_name(mass_column), -1e12, 1e12);
    rows.push_back(row);
  }
  if (rows.empty()) throw InputError(std::string(name) + ": no positions");
  sort_and_check(rows, name);
  return rows;
}

std::vector<TableRow> read_track_table(const std::filesystem::path& path, double um_per_px) {
  return parse_track_table(read_file(path, max_table_bytes), path.string(), um_per_px);
}

TrackResult tracks_of_table(const std::vector<TableRow>& table, const std::string& source,
                            const TrackSettings& settings) {
  const double scale = settings.um_per_px.value_or(1);
  TrackResult result{.source = source,
                     .settings = settings,
                     .frame_time = 1 / settings.rate.value_or(1),
                     .promised = {},
                     .rows = {},
                     .events = {}};
  if (table.empty()) return result;
  RobotTracker tracker(settings.track, settings.find.diameter * scale, result.frame_time);
  double lowest = 0;
  for (const TableRow& row : table) lowest = std::max(lowest, row.at_px.y);
  const int height = static_cast<int>(std::ceil(lowest)) + 1;
  std::map<int, TrackRow> last;
  std::vector<Vec2> places;
  std::size_t i = 0;
  for (int frame = 0; i < table.size(); ++frame) {
    const std::size_t first = i;
    places.clear();
    for (; i < table.size() && table[i].frame == frame; ++i)
      places.push_back(place_in_world(table[i].at_px, height, scale));
    const bool is_linked = first < i && table[first].id.has_value();
    const std::vector<SeenRobot>* seen = is_linked ? nullptr : &tracker.step(frame, places);
    for (std::size_t k = first; k < i; ++k) {
      const std::size_t n = k - first;
      TrackRow row{.frame = frame,
                   .t = frame * result.frame_time,
                   .id = seen ? (*seen)[n].id : *table[k].id,
                   .position = places[n],
                   .velocity = seen ? (*seen)[n].velocity : Vec2{},
                   .mass = table[k].mass,
                   .at_px = table[k].at_px};
      if (const auto before = last.find(row.id); !seen && before != last.end())
        row.velocity = (row.position - before->second.position) / (row.t - before->second.t);
      if (!seen) last[row.id] = row;
      result.rows.push_back(row);
    }
  }
  tracker.finish();
  result.events = tracker.events();
  result.frames = table.back().frame + 1;
  return result;
}

}  // namespace microswarm::vision
