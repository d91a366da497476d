// SPDX-License-Identifier: Apache-2.0
#include "microswarm/vision/tracking/track_table.hpp"

#include <fmt/format.h>

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
#include "microswarm/vision/camera/frame_times.hpp"
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
  x_um_column,
  y_um_column,
  radius_column,
  signal_column,
  eccentricity_column,
  ecc_column,
  columns
};

/// Names of the columns in the tables of one program; the first three are needed.
struct TableForm {
  std::array<std::string_view, columns> names;
  bool is_trackmate = false;
};
constexpr std::array<TableForm, 2> table_forms{
    {{{"frame", "x", "y", "particle", "mass", "t_s", "x_um", "y_um", "radius_um", "signal",
       "eccentricity", "ecc"}},
     {{"FRAME", "POSITION_X", "POSITION_Y", "TRACK_ID", "", "POSITION_T", "", "", "", "", "", ""},
      true}}};

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
    take_scale(table);
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
    row.radius_um = number_or_0(radius_column);
    row.signal = number_or_0(signal_column);
    row.eccentricity = number_or_0(header_->at[ecc_column] ? ecc_column : eccentricity_column);
    if (header_->at[id_column] && !has_id) {
      ++table.untracked;
      return;
    }
    table.rows.push_back(row);
    if (header_->at[x_um_column] && header_->at[y_um_column])
      places_um_.push_back({number_or_0(x_um_column), number_or_0(y_um_column)});
  }
  /// Cells of features may be empty, or nan where they could not be measured.
  double number_or_0(TableColumn c) const {
    const double value = header_->at[c] ? parse_number(field(c)).value_or(0) : 0;
    return std::isfinite(value) ? value : 0;
  }

  /// Scale and height of the pictures from positions in both px and µm, which go together as those
  /// of tracks.csv do: x_um = s (x + 1/2), y_um = s (height - 1/2 - y).
  void take_scale(TrackTable& table) const {
    constexpr double rounding = 0.02;  // [px], of printed positions
    if (places_um_.empty()) return;
    double products = 0, squares = 0;
    for (std::size_t i = 0; i < table.rows.size(); ++i) {
      const double x = table.rows[i].at_px.x + 0.5;
      products += x * places_um_[i].x;
      squares += x * x;
    }
    const double scale = squares > 0 ? products / squares : 0;
    const auto height_of = [&](std::size_t i) {
      return places_um_[i].y / scale + table.rows[i].at_px.y + 0.5;
    };
    const double height = scale > 0 ? std::round(height_of(0)) : 0;
    bool go_together = scale >= 1e-6 && scale <= 1e6 && height >= 1 && height <= max_table_position;
    for (std::size_t i = 0; i < table.rows.size() && go_together; ++i)
      go_together = std::abs(places_um_[i].x / scale - table.rows[i].at_px.x - 0.5) < rounding &&
                    std::abs(height_of(i) - height) < rounding;
    if (go_together) {
      table.um_per_px = scale;
      table.height = static_cast<int>(height);
    } else {
      table.notes.emplace_back("x_um and y_um do not go with x and y, which are read");
    }
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
  std::vector<Vec2> places_um_;            ///< of the rows, if the table has them
  std::optional<double> length_unit_ = 1;  ///< [µm]; none for px
  std::optional<double> time_unit_ = 1;    ///< [s]; none for frames
};

/// Refuses what is no text, as a video that is piped in.
void require_text(std::string_view text, std::string_view name) {
  constexpr std::size_t looked_at = 4096;
  if (text.substr(0, looked_at).find('\0') != text.npos)
    throw InputError(std::string(name),
                     "is no text: a table is expected here; videos and pictures are read from "
                     "files, which are named");
}

/// Notes on a scale that contradicts the table, and on what is missing in it.
std::vector<std::string> notes_on(const TrackTable& table, const TrackSettings& settings,
                                  std::string_view source, double lowest) {
  std::vector<std::string> notes = table.notes;
  if (table.um_per_px && settings.um_per_px &&
      std::abs(*table.um_per_px / *settings.um_per_px - 1) > 1e-3)
    notes.push_back(fmt::format("states {:.6g} µm per px, {:.6g} is taken, as asked",
                                *table.um_per_px, *settings.um_per_px));
  if (!table.height)
    notes.push_back(fmt::format(
        "states no height of the pictures: y_um counts from the lowest position, y = {:.6g} px",
        lowest));
  for (std::string& text : notes) text.insert(0, std::string(source) + ": ");
  return notes;
}

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
  const bool is_wide_xml = is_utf16(text) && text.substr(0, 4).find('<') != text.npos;
  if (!is_wide_xml) {
    refuse_utf16(text, name);
    require_text(text, name);
  }
  TrackTable table = is_wide_xml || is_xml(text) ? parse_trackmate_xml(text, name, um_per_px)
                                                 : CsvTable(text, name, um_per_px).read();
  if (table.rows.empty())
    throw InputError(std::string(name),
                     table.untracked > 0 ? "no positions in tracks" : "no positions");
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
  result.notes = notes_on(table, settings, source, lowest);
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
                         .radius = rows[k].radius_um,
                         .mass = rows[k].mass,
                         .signal = rows[k].signal,
                         .eccentricity = rows[k].eccentricity,
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
