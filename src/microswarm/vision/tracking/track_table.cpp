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
#include "microswarm/vision/tracking/table_field.hpp"
#include "microswarm/vision/tracking/trackmate_xml.hpp"

namespace microswarm::vision {
namespace {

constexpr std::uint64_t max_table_bytes = 512ULL << 20;

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

/// Rows of a table in CSV.
class CsvTable {
 public:
  CsvTable(std::string_view text, std::string_view name, std::optional<double> um_per_px)
      : lines_(text, name), um_per_px_(um_per_px) {}

  TrackTable read() {
    TrackTable table;
    while (const std::optional<std::string_view> line = lines_.next()) {
      if (trimmed(*line).empty()) continue;
      if (header_)
        take(*line, table);
      else
        header_ = find_header(lines_, *line);
    }
    return table;
  }

 private:
  void take(std::string_view line, TrackTable& table) {
    cells_ = csv_cells(line, header_->separator);
    if (cells_.size() != header_->count)
      lines_.fail(std::to_string(cells_.size()) + " fields, the header has " +
                  std::to_string(header_->count));
    if (header_->form.is_trackmate && table.rows.empty() && !parse_number(field(x_column))) {
      is_px_ = is_px_ || field(x_column).find("pixel") != std::string::npos;
      return;  // further lines of the header
    }
    const auto fail = [this](const std::string& why) { lines_.fail(why); };
    TableRow row{.frame =
                     field_whole(field(frame_column), name(frame_column), max_table_frame, fail)};
    const auto place = [&](TableColumn c) {
      return field_number(field(c), name(c), -max_table_position, max_table_position, fail) /
             per_px();
    };
    row.at_px = {place(x_column), place(y_column)};
    const bool has_id =
        header_->at[id_column] && !field(id_column).empty() && field(id_column) != "None";
    if (has_id) row.id = field_whole(field(id_column), name(id_column), max_table_id, fail);
    if (header_->at[mass_column])
      row.mass = field_number(field(mass_column), name(mass_column), -1e12, 1e12, fail);
    if (header_->at[id_column] && !has_id)
      ++table.untracked;
    else
      table.rows.push_back(row);
  }

  std::string field(TableColumn c) const {
    return csv_number(cells_[*header_->at[c]], header_->separator);
  }
  std::string_view name(TableColumn c) const { return header_->form.names[c]; }
  /// Size of a pixel in the unit of the positions.
  double per_px() const {
    if (!header_->form.is_trackmate || is_px_) return 1;
    if (!um_per_px_) lines_.fail("positions are in µm: µm per px is missing");
    return *um_per_px_;
  }

  Lines lines_;
  std::optional<double> um_per_px_;
  std::optional<TableHeader> header_;
  std::vector<std::string_view> cells_;
  bool is_px_ = false;
};

bool is_xml(std::string_view text) {
  constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
  if (text.starts_with(byte_order_mark)) text.remove_prefix(byte_order_mark.size());
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  return first != text.npos && text[first] == '<';
}

}  // namespace

TrackTable parse_track_table(std::string_view text, std::string_view name,
                             std::optional<double> um_per_px) {
  TrackTable table = is_xml(text) ? parse_trackmate_xml(text, name, um_per_px)
                                  : CsvTable(text, name, um_per_px).read();
  if (table.rows.empty())
    throw InputError(std::string(name) + ": no positions" +
                     (table.untracked > 0 ? " in tracks" : ""));
  sort_and_check(table.rows, name);
  return table;
}

TrackTable read_track_table(const std::filesystem::path& path, std::optional<double> um_per_px) {
  return parse_track_table(read_file(path, max_table_bytes), path.string(), um_per_px);
}

TrackResult tracks_of_table(const TrackTable& table, const std::string& source,
                            const TrackSettings& settings) {
  const std::vector<TableRow>& rows = table.rows;
  const double scale = settings.um_per_px.value_or(1);
  TrackResult result{.source = source,
                     .settings = settings,
                     .frame_time = 1 / settings.rate.value_or(1),
                     .promised = {},
                     .rows = {},
                     .events = {}};
  if (rows.empty()) return result;
  RobotTracker tracker(settings.track, settings.find.diameter * scale, result.frame_time);
  double lowest = 0;
  for (const TableRow& row : rows) lowest = std::max(lowest, row.at_px.y);
  const int height = table.height.value_or(static_cast<int>(std::ceil(lowest)) + 1);
  std::map<int, TrackRow> last;
  std::vector<Vec2> places;
  std::size_t i = 0;
  for (int frame = 0; i < rows.size(); ++frame) {
    const std::size_t first = i;
    places.clear();
    for (; i < rows.size() && rows[i].frame == frame; ++i)
      places.push_back(place_in_world(rows[i].at_px, height, scale));
    const bool is_linked = first < i && rows[first].id.has_value();
    const std::vector<SeenRobot>* seen = is_linked ? nullptr : &tracker.step(frame, places);
    for (std::size_t k = first; k < i; ++k) {
      const std::size_t n = k - first;
      TrackRow row{.frame = frame,
                   .t = frame * result.frame_time,
                   .id = seen ? (*seen)[n].id : *rows[k].id,
                   .position = places[n],
                   .velocity = seen ? (*seen)[n].velocity : Vec2{},
                   .mass = rows[k].mass,
                   .at_px = rows[k].at_px};
      if (const auto before = last.find(row.id); !seen && before != last.end())
        row.velocity = (row.position - before->second.position) / (row.t - before->second.t);
      if (!seen) last[row.id] = row;
      result.rows.push_back(row);
    }
  }
  tracker.finish();
  result.events = tracker.events();
  result.frames = rows.back().frame + 1;
  return result;
}

}  // namespace microswarm::vision
