// SPDX-License-Identifier: Apache-2.0
#include "microswarm/formats/moving_ai.hpp"

#include <cmath>

#include "microswarm/core/text/file.hpp"
#include "microswarm/core/text/lines.hpp"
#include "microswarm/core/text/text.hpp"
#include "microswarm/formats/images/image.hpp"

namespace microswarm::formats {
namespace {

constexpr std::uint64_t max_map_bytes = 160ULL << 20;
constexpr std::uint64_t max_scenario_bytes = 64ULL << 20;

constexpr bool is_free_letter(char c) { return c == '.' || c == 'G' || c == 'S'; }

/// Whole number in [0, limit]; otherwise fails with a message that names it.
int whole_number(const Lines& lines, std::string_view word, int limit, const std::string& what) {
  const std::optional<double> value = parse_number(word);
  if (!value || *value != std::trunc(*value))
    lines.fail(what + " " + quote(word) + " is no whole number");
  if (*value < 0 || *value > limit)
    lines.fail(what + " " + number_text(*value) + " is outside 0.." + std::to_string(limit));
  return static_cast<int>(*value);
}

/// Value of a header line "KEY VALUE".
std::string_view header_value(Lines& lines, std::string_view key) {
  const std::optional<std::string_view> line = lines.next();
  const std::vector<std::string_view> found = words(line.value_or(""));
  if (found.size() != 2 || found[0] != key)
    lines.fail(quote(std::string(key) + " ...") + " expected, not " + quote(line.value_or("")));
  return found[1];
}

/// Letters of the format: trees, water and what is out of bounds too.
constexpr std::string_view known_letters = ".GS@OTW";

void read_row(const Lines& lines, std::string_view line, int row, Mask& mask,
              std::string& unknown) {
  if (line.size() != static_cast<std::size_t>(mask.width))
    lines.fail("row of " + std::to_string(line.size()) + " cells, width is " +
               std::to_string(mask.width));
  for (int column = 0; column < mask.width; ++column) {
    const char c = line[static_cast<std::size_t>(column)];
    if (c <= ' ' || c > '~') lines.fail("column " + std::to_string(column + 1) + " is no letter");
    mask.at(column, row) = !is_free_letter(c);
    if (known_letters.find(c) == known_letters.npos && unknown.find(c) == unknown.npos)
      unknown += c;
  }
}

GridCell read_cell(const Lines& lines, std::string_view column, std::string_view row,
                   const GridQuery& query, const std::string& what) {
  return {whole_number(lines, column, query.width - 1, what + " column"),
          whole_number(lines, row, query.height - 1, what + " row")};
}

}  // namespace

Mask parse_moving_ai(std::string_view text, std::string_view name, std::string* unknown) {
  std::string others;
  Lines lines(text, name);
  const std::string_view type = header_value(lines, "type");
  if (type != "octile" && type != "tile")
    lines.fail("type " + quote(type) + " is neither octile nor tile");
  constexpr int far_too_many = 1'000'000'000;
  const int height = whole_number(lines, header_value(lines, "height"), far_too_many, "height");
  const int width = whole_number(lines, header_value(lines, "width"), far_too_many, "width");
  check_image_size(width, height, name, "cells");
  if (trimmed(lines.next().value_or("")) != "map") lines.fail("'map' expected");
  const auto cells = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  if (text.size() < cells)
    lines.fail(std::to_string(cells) + " cells expected, the file has " +
               std::to_string(text.size()) + " bytes");

  Mask mask(width, height);
  for (int row = 0; row < height; ++row) {
    const std::optional<std::string_view> line = lines.next();
    if (!line)
      lines.fail("truncated: " + std::to_string(height) + " rows expected, " + std::to_string(row) +
                 " there");
    read_row(lines, *line, row, mask, others);
  }
  while (const std::optional<std::string_view> line = lines.next())
    if (!trimmed(*line).empty()) lines.fail("more than " + std::to_string(height) + " rows");
  if (unknown) *unknown = others;
  return mask;
}

Mask read_moving_ai(const std::filesystem::path& path, std::string* unknown) {
  return parse_moving_ai(read_file(path, max_map_bytes), path.string(), unknown);
}

std::string moving_ai_text(const Mask& blocked) {
  std::string out = "type octile\nheight " + std::to_string(blocked.height) + "\nwidth " +
                    std::to_string(blocked.width) + "\nmap\n";
  for (int row = 0; row < blocked.height; ++row) {
    for (int column = 0; column < blocked.width; ++column)
      out += blocked.at(column, row) ? '@' : '.';
    out += '\n';
  }
  return out;
}

std::vector<GridQuery> parse_scenarios(std::string_view text, std::string_view name) {
  Lines lines(text, name);
  if (const std::string_view version = header_value(lines, "version");
      version != "1" && version != "1.0")
    lines.fail("version " + quote(version) + ", only 1 is read");
  std::vector<GridQuery> queries;
  while (const std::optional<std::string_view> line = lines.next()) {
    if (trimmed(*line).empty()) continue;
    const std::vector<std::string_view> field = split(*line, '\t');
    if (field.size() != 9)
      lines.fail("9 fields between tabs expected, " + std::to_string(field.size()) + " there");
    GridQuery query;
    query.map = field[1];
    query.width = whole_number(lines, field[2], max_image_side, "width");
    query.height = whole_number(lines, field[3], max_image_side, "height");
    query.start = read_cell(lines, field[4], field[5], query, "start");
    query.goal = read_cell(lines, field[6], field[7], query, "goal");
    const std::optional<double> length = parse_number(field[8]);
    if (!length || *length < 0) lines.fail("length " + quote(field[8]) + " is no length");
    query.optimal_length = *length;
    queries.push_back(std::move(query));
  }
  return queries;
}

std::vector<GridQuery> read_scenarios(const std::filesystem::path& path) {
  return parse_scenarios(read_file(path, max_scenario_bytes), path.string());
}

}  // namespace microswarm::formats
