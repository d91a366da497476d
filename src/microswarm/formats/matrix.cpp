// SPDX-License-Identifier: Apache-2.0
#include "microswarm/formats/matrix.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <set>
#include <vector>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/text/csv.hpp"
#include "microswarm/core/text/file.hpp"
#include "microswarm/core/text/lines.hpp"
#include "microswarm/core/text/text.hpp"
#include "microswarm/formats/images/image.hpp"

namespace microswarm::formats {
namespace {

/// Twice the pixels of the largest picture, for a digit and a separator each, with room to spare.
constexpr std::uint64_t max_matrix_bytes = 320ULL << 20;

bool is_comment(std::string_view line) {
  return line.empty() || line.front() == '#' || line.front() == '%' || line.starts_with("//");
}

bool is_digits(std::string_view word) {
  return word.find_first_not_of("01") == std::string_view::npos;
}

/// The fields of a row, between any of the separators, one of which may end it, without quotes.
std::vector<std::string_view> matrix_fields(std::string_view row) {
  if (row.ends_with(',') || row.ends_with(';')) row = trimmed(row.substr(0, row.size() - 1));
  for (const char separator : {',', ';'})
    if (row.find(separator) != std::string_view::npos) return csv_cells(row, separator);
  std::vector<std::string_view> fields = words(row);
  for (std::string_view& field : fields)
    if (field.size() > 2 && field.front() == '"' && field.back() == '"')
      field = field.substr(1, field.size() - 2);
  return fields;
}

/// The cells of a row; nothing where a field is neither 0 nor 1, which `bad` receives.
std::optional<std::vector<std::uint8_t>> row_cells(std::string_view row, std::string_view& bad) {
  std::vector<std::uint8_t> cells;
  const std::vector<std::string_view> fields = matrix_fields(row);
  if (fields.size() == 1 && is_digits(fields[0])) {
    for (const char c : fields[0]) cells.push_back(c == '1');
    return cells;
  }
  for (const std::string_view field : fields) {
    const std::optional<double> number = parse_number(field);
    if (number != 0.0 && number != 1.0) {
      bad = field;
      return std::nullopt;
    }
    cells.push_back(number == 1.0);
  }
  return cells;
}

}  // namespace

Mask parse_matrix(std::string_view text, std::string_view name) {
  Lines lines(text, name);
  std::vector<std::uint8_t> all;
  std::size_t width = 0;
  std::string_view bad;
  while (const std::optional<std::string_view> line = lines.next()) {
    const std::string_view row = trimmed(*line);
    if (is_comment(row)) continue;
    const auto cells = row_cells(row, bad);
    if (!cells) lines.fail(quote(bad) + " is neither 0 nor 1");
    if (width > 0 && cells->size() != width)
      lines.fail(fmt::format("row of {} cells, {} in the first", cells->size(), width));
    width = cells->size();
    all.insert(all.end(), cells->begin(), cells->end());
    check_image_size(static_cast<std::int64_t>(width),
                     static_cast<std::int64_t>(all.size() / std::max<std::size_t>(width, 1)), name,
                     "cells");
  }
  if (width == 0) throw InputError(std::string(name), "no rows of 0 and 1");
  Mask ones(static_cast<int>(width), static_cast<int>(all.size() / width));
  ones.cells = std::move(all);
  return ones;
}

bool is_matrix(std::string_view text) {
  Lines lines(text, "");
  std::size_t rows = 0, good = 0, width = 0;
  std::string_view bad;
  while (const std::optional<std::string_view> line = lines.next()) {
    const std::string_view row = trimmed(*line);
    if (is_comment(row)) continue;
    const auto cells = row_cells(row, bad);
    ++rows;
    good += cells.has_value();
    if (cells) width = std::max(width, cells->size());
  }
  constexpr std::size_t of_rectangle = 4;
  return width >= 2 && (good == rows || (width != of_rectangle && 2 * good > rows));
}

Mask read_matrix(const std::filesystem::path& path) {
  return parse_matrix(read_file(path, max_matrix_bytes), path.string());
}

bool resembles_matrix(std::string_view text) {
  Lines lines(text, "");
  std::size_t rows = 0, of_bits = 0;
  std::set<double> values;
  std::string_view bad;
  while (const std::optional<std::string_view> line = lines.next()) {
    const std::string_view row = trimmed(*line);
    if (is_comment(row)) continue;
    ++rows;
    of_bits += row_cells(row, bad).has_value();
    for (const std::string_view field : matrix_fields(row)) {
      const std::optional<double> number = parse_number(field);
      if (!number || *number != std::floor(*number)) return false;
      if (values.size() < 3) values.insert(*number);
    }
  }
  constexpr std::size_t few = 2;
  return rows > few && (2 * of_bits > rows || values.size() <= 2);
}

bool is_matrix_file(const std::filesystem::path& path) {
  std::string text;
  try {
    text = read_file(path, max_matrix_bytes);
  } catch (const InputError&) {
    return false;
  }
  require_utf8(text, path.string());
  return is_matrix(text);
}

}  // namespace microswarm::formats
