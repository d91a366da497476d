// SPDX-License-Identifier: Apache-2.0
#include "microswarm/formats/tracks.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/text/csv.hpp"
#include "microswarm/core/text/file.hpp"
#include "microswarm/core/text/lines.hpp"
#include "microswarm/core/text/text.hpp"
#include "microswarm/formats/map_parts.hpp"

namespace microswarm::formats {
namespace {

constexpr std::uint64_t max_tracks_bytes = 256ULL << 20;
constexpr double max_time = 1e9;  // [s]

enum Column : std::size_t { id, time_s, x_um, y_um, column_count };
constexpr std::array<std::string_view, column_count> column_names{"id", "t_s", "x_um", "y_um"};

/// Index of each column in the header.
std::array<std::size_t, column_count> find_columns(const Lines& lines, std::string_view header,
                                                   char separator) {
  const std::vector<std::string_view> names = csv_cells(header, separator);
  std::array<std::size_t, column_count> places{};
  for (std::size_t c = 0; c < column_count; ++c) {
    std::string_view name = column_names[c];
    auto found = std::find(names.begin(), names.end(), name);
    if (c == id && found == names.end()) {
      const auto other = std::find(names.begin(), names.end(), "particle");
      if (other != names.end()) name = "particle", found = other;
    }
    const std::string wanted = "column '" + std::string(name) + "'";
    if (found == names.end()) lines.fail(wanted + " is missing: id,t_s,x_um,y_um expected");
    if (std::find(found + 1, names.end(), name) != names.end())
      lines.fail(wanted + " stands twice");
    places[c] = static_cast<std::size_t>(found - names.begin());
  }
  return places;
}

double number(const Lines& lines, std::string_view word, std::string_view what, double limit) {
  const std::optional<double> value = parse_number(word);
  if (!value) lines.fail(std::string(what) + " " + quote(word) + " is no number");
  if (!(std::abs(*value) <= limit))
    lines.fail(std::string(what) + " " + number_text(*value) + ", at most " + number_text(limit));
  return *value;
}

void append(const Lines& lines, Tracks& tracks, std::string_view body, double time, Vec2 point) {
  if (body.empty()) lines.fail("id is empty");
  if (body.size() > 200) lines.fail("id of " + std::to_string(body.size()) + " bytes, at most 200");
  Samples& samples = tracks[std::string(body)];
  if (!samples.times.empty() && !(time > samples.times.back()))
    lines.fail("time " + number_text(time) + " s of id " + quote(body) + " is not after " +
               number_text(samples.times.back()) + " s");
  samples.times.push_back(time);
  samples.points.push_back(point);
}

bool says_nothing(std::string_view line) {
  line = trimmed(line);
  return line.empty() || line.front() == '#';
}

}  // namespace

Tracks parse_tracks(std::string_view text, std::string_view name) {
  Lines lines(text, name);
  Tracks tracks;
  std::optional<std::array<std::size_t, column_count>> places;
  std::size_t columns = 0;
  char separator = ',';
  while (const std::optional<std::string_view> line = lines.next()) {
    if (says_nothing(*line)) continue;
    if (!places) {
      separator = csv_separator(*line);
      require_clear_commas(text, name, separator);
    }
    const std::vector<std::string_view> field = csv_cells(*line, separator);
    if (!places) {
      places = find_columns(lines, *line, separator);
      columns = field.size();
      continue;
    }
    if (field.size() != columns)
      lines.fail(std::to_string(field.size()) + " fields, the header has " +
                 std::to_string(columns));
    const auto value = [&](Column c, double limit) {
      return number(lines, csv_number(field[(*places)[c]], separator), column_names[c], limit);
    };
    append(lines, tracks, field[(*places)[id]], value(time_s, max_time),
           {value(x_um, max_coordinate), value(y_um, max_coordinate)});
  }
  if (tracks.empty())
    throw InputError(std::string(name), "no tracks: columns id,t_s,x_um,y_um and rows expected");
  return tracks;
}

Tracks read_tracks(const std::filesystem::path& path) {
  return parse_tracks(read_file(path, max_tracks_bytes), path.string());
}

Tracks read_ucy_obsmat(const std::filesystem::path& path, double um_per_m, double time_scale) {
  constexpr double seconds_per_frame = 0.04;
  const std::string text = read_file(path, max_tracks_bytes);
  Lines lines(text, path.string());
  Tracks tracks;
  while (const std::optional<std::string_view> line = lines.next()) {
    if (says_nothing(*line)) continue;
    const std::vector<std::string_view> field = words(*line);
    if (field.size() != 8)
      lines.fail("8 columns expected, " + std::to_string(field.size()) + " there");
    const double frame = number(lines, field[0], "frame", max_time);
    const double body = number(lines, field[1], "id", max_time);
    const Vec2 point{number(lines, field[2], "x", max_coordinate / um_per_m),
                     number(lines, field[4], "y", max_coordinate / um_per_m)};
    append(lines, tracks, number_text(body), frame * seconds_per_frame * time_scale,
           um_per_m * point);
  }
  if (tracks.empty()) throw InputError(path.string(), "no tracks");
  return tracks;
}

}  // namespace microswarm::formats
