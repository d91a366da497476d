// SPDX-License-Identifier: Apache-2.0
#include "microswarm/formats/rectangles.hpp"

#include <algorithm>
#include <array>
#include <optional>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/errors/input_names.hpp"
#include "microswarm/core/text/csv.hpp"
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

/// Separator of the fields of a table by its first line: ';', a tab, a comma, or ' ' for blanks.
char rectangle_separator(std::string_view line) {
  if (line.find(';') != std::string_view::npos) return ';';
  const auto is_no_cell = [](std::string_view field) {
    return field.starts_with(',') || field.ends_with(',') || words(field).size() > 1;
  };
  const bool has_tab = line.find('\t') != std::string_view::npos;
  if (has_tab && std::ranges::none_of(split(line, '\t'), is_no_cell)) return '\t';
  return line.find(',') == std::string_view::npos ? ' ' : ',';
}

/// The fields of a line, without double quotes around them.
std::vector<std::string_view> rectangle_fields(std::string_view line, char separator) {
  return separator == ' ' ? words(line) : csv_cells(line, separator);
}

/// Whether a header names columns of tracks, which are four too.
bool names_tracks(const std::vector<std::string_view>& header) {
  constexpr std::string_view of_tracks[] = {"id", "t", "t_s", "time", "time_s", "frame", "track"};
  return std::ranges::any_of(header, [&](std::string_view column) {
    return std::ranges::find(of_tracks, column) != std::end(of_tracks);
  });
}

/// Places of x, y, width and height among the columns of a rectangles' table.
using RectangleColumns = std::array<std::size_t, 4>;

/// The columns by their names, in any order. A first one without a name holds those of the rows,
/// as R and pandas write them. Refuses others, and a unit other than µm.
RectangleColumns find_columns(const Lines& lines, const std::vector<std::string_view>& header) {
  constexpr std::array<std::array<std::string_view, 3>, 4> names{{{"x", "left", "x_um"},
                                                                  {"y", "bottom", "y_um"},
                                                                  {"width", "w", "width_um"},
                                                                  {"height", "h", "height_um"}}};
  constexpr std::size_t missing = ~std::size_t{0};
  RectangleColumns found{missing, missing, missing, missing};
  const std::string expected =
      "rectangles have x,y,width,height, (x, y) being the lower left corner; for other units "
      "give " +
      input_name("um_per_unit");
  for (std::size_t column = 0; column < header.size(); ++column) {
    if (column == 0 && header[column].empty()) continue;
    std::string name(header[column]);
    std::ranges::transform(name, name.begin(), [](char c) {
      return c == 'X' || c == 'Y' || c == 'W' || c == 'H' ? static_cast<char>(c - 'A' + 'a') : c;
    });
    const auto is_named = [&](const auto& of_one) {
      return std::ranges::find(of_one, name) != of_one.end();
    };
    const auto quantity = std::ranges::find_if(names, is_named);
    if (quantity == names.end())
      lines.fail("column " + quote(header[column]) + ": " + std::string(expected));
    std::size_t& place = found[static_cast<std::size_t>(quantity - names.begin())];
    if (place != missing) lines.fail("two columns of " + std::string(quantity->front()));
    place = column;
  }
  for (std::size_t i = 0; i < names.size(); ++i)
    if (found[i] == missing)
      lines.fail("no column of " + std::string(names[i].front()) + ": " + std::string(expected));
  return found;
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
    throw InputError(where,
                     std::to_string(numbers.size()) + " numbers, 4 expected: x, y, width, height");
  const double x = numbers[0], y = numbers[1], width = numbers[2], height = numbers[3];
  if (!(x + width > x && y + height > y))
    throw InputError(where, "width " + number_text(width) + " and height " + number_text(height) +
                                " µm must be above 0");
  return {{{x, y}, {x + width, y}, {x + width, y + height}, {x, y + height}}, {}};
}

std::vector<Polygon> parse_rectangles(std::string_view text, std::string_view name,
                                      double um_per_unit) {
  Lines lines(text, name);
  std::vector<Polygon> rectangles;
  RectangleColumns columns{0, 1, 2, 3};
  std::size_t in_row = columns.size();
  std::optional<char> separator;
  while (const std::optional<std::string_view> raw = lines.next()) {
    const std::string_view line = trimmed(*raw);
    if (line.empty() || line.front() == '#') continue;
    const bool is_first = !separator;
    if (is_first) {
      separator = rectangle_separator(line);
      require_clear_commas(text, name, *separator);
    }
    const std::vector<std::string_view> fields = rectangle_fields(line, *separator);
    if (is_first && !has_number(fields)) {
      if (names_tracks(fields))
        lines.fail("columns of tracks, not of rectangles: x,y,width,height expected");
      columns = find_columns(lines, fields);
      in_row = fields.size();
      continue;
    }
    std::vector<double> numbers;
    for (std::size_t i = 0; i < fields.size(); ++i) {
      const std::size_t column = fields.size() == in_row && i < columns.size() ? columns[i] : i;
      if (fields.size() == in_row && i >= columns.size()) break;  // the names of rows
      const std::optional<double> number = rectangle_number(fields[column]);
      if (!number) lines.fail(quote(fields[column]) + " is no number");
      numbers.push_back(um_per_unit * *number);
    }
    rectangles.push_back(
        rectangle(numbers, std::string(name) + ":" + std::to_string(lines.number())));
  }
  if (rectangles.empty())
    throw InputError(std::string(name), "no rectangles: lines of x,y,width,height expected");
  return rectangles;
}

std::vector<Polygon> read_rectangles(const std::filesystem::path& path, double um_per_unit) {
  return parse_rectangles(read_file(path, max_rectangles_bytes), path.string(), um_per_unit);
}

}  // namespace microswarm::formats
