// SPDX-License-Identifier: Apache-2.0
#include "microswarm/vision/tracking/track_table.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <span>
#include <utility>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/text/csv.hpp"
#include "microswarm/core/text/file.hpp"
#include "microswarm/core/text/lines.hpp"
#include "microswarm/core/text/text.hpp"
#include "microswarm/core/text/unit_names.hpp"
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
  time_column,
  columns
};

/// Names of the columns in the tables of one program; the first three are needed.
struct TableForm {
  std::array<std::string_view, columns> names;
  bool is_trackmate = false;
};
constexpr std::array<TableForm, 2> table_forms{
    {{{"frame", "x", "y", "particle", "mass", "t_s"}},
     {{"FRAME", "POSITION_X", "POSITION_Y", "TRACK_ID", "", "POSITION_T"}, true}}};

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

/// Refuses a row: "NAME:LINE: WHY".
[[noreturn]] void fail_at(std::string_view name, const TableRow& row, const std::string& why) {
  throw InputError(std::string(name), row.line, 0, why);
}

void sort_and_check(std::vector<TableRow>& rows, std::string_view name) {
  std::stable_sort(rows.begin(), rows.end(),
                   [](const TableRow& a, const TableRow& b) { return a.frame < b.frame; });
  std::set<int> ids;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (i > 0 && rows[i].frame != rows[i - 1].frame) ids.clear();
    if (rows[i].id && !ids.insert(*rows[i].id).second)
      fail_at(name, rows[i],
              "track " + std::to_string(*rows[i].id) + " has two positions in frame " +
                  std::to_string(rows[i].frame) + ", tracks that divide or merge are not taken");
  }
}

/// Rows of a table in CSV.
class CsvTable {
 public:
  CsvTable(std::string_view text, std::string_view name, std::optional<double> um_per_px)
      : text_(text), name_(name), lines_(text, name), um_per_px_(um_per_px) {}

  TrackTable read() {
    TrackTable table;
    while (const std::optional<std::string_view> line = lines_.next()) {
      if (trimmed(*line).empty()) continue;
      if (header_) {
        take(*line, table);
        continue;
      }
      header_ = find_header(lines_, *line);
      require_clear_commas(text_, name_, header_->separator);
    }
    return table;
  }

 private:
  void take(std::string_view line, TrackTable& table) {
    cells_ = csv_cells(line, header_->separator);
    if (cells_.size() != header_->count)
      lines_.fail(std::to_string(cells_.size()) + " fields, the header has " +
                  std::to_string(header_->count));
    if (header_->form.is_trackmate && table.rows.empty() && !parse_number(field(x_column)))
      return take_units();
    const auto fail = [this](const std::string& why) { lines_.fail(why); };
    TableRow row{
        .frame = field_whole(field(frame_column), name(frame_column), max_table_frame, fail),
        .line = lines_.number()};
    const auto place = [&](TableColumn c) {
      return field_number(field(c), name(c), -max_table_position, max_table_position, fail) /
             per_px();
    };
    row.at_px = {place(x_column), place(y_column)};
    if (time_unit_ && header_->at[time_column] && !field(time_column).empty())
      row.t = field_number(field(time_column), name(time_column), -1e12, 1e12, fail) * *time_unit_;
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
  /// A further line of the header: units in parentheses, or other names.
  void take_units() {
    const auto unit_of = [&](TableColumn c) {
      const std::string text = header_->at[c] ? field(c) : std::string();
      return text.size() > 2 && text.front() == '(' && text.back() == ')'
                 ? text.substr(1, text.size() - 2)
                 : std::string();
    };
    if (const std::string unit = unit_of(x_column); !unit.empty()) {
      length_unit_ = length_unit_um(unit);
      if (!length_unit_ && !is_pixel_unit(unit))
        lines_.fail("unit " + quote(unit) + " is not known");
    }
    if (const std::string unit = unit_of(time_column); !unit.empty()) {
      time_unit_ = time_unit_s(unit);
      if (!time_unit_ && unit != "frame" && unit != "frames")
        lines_.fail("unit " + quote(unit) + " is not known");
    }
  }
  /// Size of a pixel in the unit of the positions.
  double per_px() const {
    if (!header_->form.is_trackmate || !length_unit_) return 1;
    if (!um_per_px_) lines_.fail("positions are in units of length: µm per px is missing");
    return *um_per_px_ / *length_unit_;
  }

  std::string_view text_, name_;
  Lines lines_;
  std::optional<double> um_per_px_;
  std::optional<TableHeader> header_;
  std::vector<std::string_view> cells_;
  std::optional<double> length_unit_ = 1;  ///< [µm]; none for px
  std::optional<double> time_unit_ = 1;    ///< [s]; none for frames
};

bool is_xml(std::string_view text) {
  constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
  if (text.starts_with(byte_order_mark)) text.remove_prefix(byte_order_mark.size());
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  return first != text.npos && text[first] == '<';
}

/// Times of the frames [s]; `interval` is the usual one.
std::vector<double> frame_times(const TrackTable& table, const TrackSettings& settings,
                                std::string_view source, double& interval) {
  const std::vector<TableRow>& rows = table.rows;
  std::vector<double> times(static_cast<std::size_t>(rows.back().frame) + 1);
  const bool are_given = !settings.rate && std::ranges::any_of(rows, [](const TableRow& row) {
    return row.t.has_value();
  });
  interval = settings.rate ? 1 / *settings.rate : table.interval.value_or(1);
  if (!are_given) {
    for (std::size_t k = 0; k < times.size(); ++k) times[k] = static_cast<double>(k) * interval;
    return times;
  }
  std::vector<const TableRow*> known;  // one of each frame
  for (const TableRow& row : rows) {
    if (!row.t) fail_at(source, row, "no time, which other positions have");
    if (!known.empty() && known.back()->frame == row.frame) {
      if (known.back()->t != row.t)
        fail_at(source, row,
                "frame " + std::to_string(row.frame) + " has two times, " +
                    number_text(*known.back()->t) + " and " + number_text(*row.t) + " s");
      continue;
    }
    if (!known.empty() && !(*row.t > *known.back()->t))
      fail_at(source, row,
              "frame " + std::to_string(row.frame) + " is at " + number_text(*row.t) +
                  " s, not after frame " + std::to_string(known.back()->frame) + " at " +
                  number_text(*known.back()->t) + " s");
    known.push_back(&row);
  }
  if (known.size() > 1)
    interval =
        (*known.back()->t - *known.front()->t) / (known.back()->frame - known.front()->frame);
  std::size_t next = 0;
  for (std::size_t k = 0; k < times.size(); ++k) {
    const int frame = static_cast<int>(k);
    while (next + 1 < known.size() && known[next]->frame < frame) ++next;
    const TableRow& after = *known[next];
    if (next == 0 || after.frame == frame) {
      times[k] = *after.t + (frame - after.frame) * interval;
      continue;
    }
    const TableRow& before = *known[next - 1];
    times[k] =
        *before.t + (*after.t - *before.t) * (frame - before.frame) / (after.frame - before.frame);
  }
  return times;
}

}  // namespace

bool is_track_table(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  std::ranges::transform(extension, extension.begin(), [](unsigned char c) {
    return static_cast<char>(c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c);
  });
  return path == "/dev/stdin" || extension == ".csv" || extension == ".tsv" ||
         extension == ".txt" || extension == ".xml";
}

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
                     .promised = {},
                     .times = {},
                     .notes = {},
                     .rows = {},
                     .events = {}};
  if (rows.empty()) return result;
  result.times = frame_times(table, settings, source, result.frame_time);
  RobotTracker tracker(settings.track, settings.find.diameter * scale, result.frame_time);
  double lowest = 0;
  for (const TableRow& row : rows) lowest = std::max(lowest, row.at_px.y);
  const int height = table.height.value_or(static_cast<int>(std::ceil(lowest)) + 1);
  std::vector<Vec2> places;
  std::size_t i = 0;
  for (int frame = 0; i < rows.size(); ++frame) {
    const std::size_t first = i;
    const std::size_t at = static_cast<std::size_t>(frame);
    const auto elapsed =
        at > 0 ? std::optional(result.times[at] - result.times[at - 1]) : std::nullopt;
    places.clear();
    for (; i < rows.size() && rows[i].frame == frame; ++i)
      places.push_back(place_in_world(rows[i].at_px, height, scale));
    const bool is_linked = first < i && rows[first].id.has_value();
    const std::vector<SeenRobot>* seen =
        is_linked ? nullptr : &tracker.step(frame, places, elapsed);
    for (std::size_t k = first; k < i; ++k) {
      const std::size_t n = k - first;
      const TrackRow row{.frame = frame,
                         .t = result.times[at],
                         .id = seen ? (*seen)[n].id : *rows[k].id,
                         .position = places[n],
                         .mass = rows[k].mass,
                         .at_px = rows[k].at_px};
      result.rows.push_back(row);
    }
  }
  tracker.finish();
  take_velocities(result.rows);
  result.events = tracker.events();
  result.frames = rows.back().frame + 1;
  return result;
}

}  // namespace microswarm::vision
