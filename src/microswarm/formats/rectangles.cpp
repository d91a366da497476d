// SPDX-License-Identifier: Apache-2.0
#include "microswarm/formats/rectangles.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/text/file.hpp"
#include "microswarm/core/text/lines.hpp"
#include "microswarm/core/text/text.hpp"

namespace microswarm::formats {
namespace {

constexpr std::uint64_t max_rectangles_bytes = 64ULL << 20;

bool has_number(const std::vector<std::string_view>& fields) {
  return std::any_of(fields.begin(), fields.end(),
                     [](std::string_view f) { return parse_number(f).has_value(); });
}

/// The fields of a line, without double quotes around them.
std::vector<std::string_view> rectangle_fields(std::string_view line) {
  std::vector<std::string_view> fields;
  if (line.find(';') != std::string_view::npos)
    fields = split(line, ';');
  else if (line.find(',') != std::string_view::npos)
    fields = split(line, ',');
  else
    fields = words(line);
  for (std::string_view& field : fields)
    if (field.size() >= 2 && field.front() == '"' && field.back() == '"')
      field = trimmed(field.substr(1, field.size() - 2));
  return fields;
}

/// Whether a header names columns of tracks, which are four too.
bool names_tracks(const std::vector<std::string_view>& header) {
  constexpr std::string_view of_tracks[] = {"id", "t", "t_s", "time", "time_s", "frame", "track"};
  return std::ranges::any_of(header, [&](std::string_view column) {
    return std::ranges::find(of_tracks, column) != std::end(of_tracks);
  });
}

/// Refuses a header whose columns are not x, y, width and height in this order, without units.
void check_columns(const Lines& lines, const std::vector<std::string_view>& header) {
  constexpr std::array<std::array<std::string_view, 4>, 4> names{
      {{"x", "left", "x_um", "X"},
       {"y", "bottom", "y_um", "Y"},
       {"width", "w", "width_um", "W"},
       {"height", "h", "height_um", "H"}}};
  for (std::size_t i = 0; i < std::min(header.size(), names.size()); ++i)
    if (std::ranges::find(names[i], header[i]) == names[i].end())
      lines.fail("column " + quote(header[i]) + " where " + std::string(names[i][0]) +
                 " stands in rectangles: x,y,width,height expected in this order, the lower left "
                 "corner first; "
                 "other units by um_per_unit (--um-per-unit)");
}

/// A number, between semicolons also with a decimal comma.
std::optional<double> rectangle_number(std::string_view field) {
  const std::size_t comma = field.find(',');
  if (comma == std::string_view::npos) return parse_number(field);
  std::string text(field);
  text[comma] = '.';
  return parse_number(text);
}

}  // namespace

Polygon rectangle(std::span<const double> numbers, const std::string& where) {
  if (numbers.size() != 4)
    throw InputError(where + ": " + std::to_string(numbers.size()) +
                     " numbers, 4 expected: x, y, width, height");
  const double x = numbers[0], y = numbers[1], width = numbers[2], height = numbers[3];
  if (!(x + width > x && y + height > y))
    throw InputError(where + ": width " + number_text(width) + " and height " +
                     number_text(height) + " µm must be above 0");
  return {{{x, y}, {x + width, y}, {x + width, y + height}, {x, y + height}}, {}};
}

std::vector<Polygon> parse_rectangles(std::string_view text, std::string_view name,
                                      double um_per_unit) {
  Lines lines(text, name);
  std::vector<Polygon> rectangles;
  bool first = true;
  while (const std::optional<std::string_view> raw = lines.next()) {
    const std::string_view line = trimmed(*raw);
    if (line.empty() || line.front() == '#') continue;
    const std::vector<std::string_view> fields = rectangle_fields(line);
    if (std::exchange(first, false) && !has_number(fields)) {
      if (names_tracks(fields))
        lines.fail("columns of tracks, not of rectangles: x,y,width,height expected");
      check_columns(lines, fields);
      continue;
    }
    std::vector<double> numbers;
    for (const std::string_view field : fields) {
      const std::optional<double> number = rectangle_number(field);
      if (!number) lines.fail(quote(field) + " is no number");
      numbers.push_back(um_per_unit * *number);
    }
    rectangles.push_back(
        rectangle(numbers, std::string(name) + ":" + std::to_string(lines.number())));
  }
  if (rectangles.empty())
    throw InputError(std::string(name) + ": no rectangles: lines of x,y,width,height expected");
  return rectangles;
}

std::vector<Polygon> read_rectangles(const std::filesystem::path& path, double um_per_unit) {
  return parse_rectangles(read_file(path, max_rectangles_bytes), path.string(), um_per_unit);
}

}  // namespace microswarm::formats
