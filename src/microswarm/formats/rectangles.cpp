// SPDX-License-Identifier: Apache-2.0
#include "microswarm/formats/rectangles.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "microswarm/core/errors/error.hpp"
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

/// The fields of a line between ';' or commas, without double quotes around them, else words.
std::vector<std::string_view> rectangle_fields(std::string_view line) {
  for (const char separator : {';', ','})
    if (line.find(separator) != std::string_view::npos) return csv_cells(line, separator);
  return words(line);
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

/// The columns by their names, in any order. Refuses others, and a unit other than µm.
RectangleColumns find_columns(const Lines& lines, const std::vector<std::string_view>& header) {
  constexpr std::array<std::array<std::string_view, 3>, 4> names{{{"x", "left", "x_um"},
                                                                  {"y", "bottom", "y_um"},
                                                                  {"width", "w", "width_um"},
                                                                  {"height", "h", "height_um"}}};
  constexpr std::size_t missing = ~std::size_t{0};
  RectangleColumns found{missing, missing, missing, missing};
  constexpr std::string_view expected =
      "rectangles have x,y,width,height, (x, y) being the lower left corner; other units by "
      "um_per_unit (--um-per-unit)";
  for (std::size_t column = 0; column < header.size(); ++column) {
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
  RectangleColumns columns{0, 1, 2, 3};
  bool first = true;
  while (const std::optional<std::string_view> raw = lines.next()) {
    const std::string_view line = trimmed(*raw);
    if (line.empty() || line.front() == '#') continue;
    const std::vector<std::string_view> fields = rectangle_fields(line);
    if (std::exchange(first, false) && !has_number(fields)) {
      if (names_tracks(fields))
        lines.fail("columns of tracks, not of rectangles: x,y,width,height expected");
      columns = find_columns(lines, fields);
      continue;
    }
    std::vector<double> numbers;
    for (const std::string_view field : fields) {
      const std::optional<double> number = rectangle_number(field);
      if (!number) lines.fail(quote(field) + " is no number");
      numbers.push_back(um_per_unit * *number);
    }
    if (numbers.size() == columns.size()) {
      const std::vector<double> in_file = numbers;
      for (std::size_t i = 0; i < columns.size(); ++i) numbers[i] = in_file[columns[i]];
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
