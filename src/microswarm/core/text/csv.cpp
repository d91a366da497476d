// SPDX-License-Identifier: Apache-2.0
#include "microswarm/core/text/csv.hpp"

#include <algorithm>

#include "microswarm/core/text/lines.hpp"

namespace microswarm {
namespace {

/// Place of the quote that ends a quoted cell: the first that is not doubled; npos without one.
std::size_t closing_quote(std::string_view row, std::size_t open) {
  std::size_t at = row.find('"', open + 1);
  while (at != std::string_view::npos && row.substr(at + 1).starts_with('"'))
    at = row.find('"', at + 2);
  return at;
}

std::string_view unquoted(std::string_view cell) {
  const bool is_quoted = cell.size() > 1 && cell.front() == '"' && cell.back() == '"';
  return is_quoted ? trimmed(cell.substr(1, cell.size() - 2)) : cell;
}

}  // namespace

char csv_separator(std::string_view header) {
  for (const char separator : {',', ';', '\t'})
    if (header.find(separator) != std::string_view::npos) return separator;
  return ',';
}

std::vector<std::string_view> csv_cells(std::string_view row, char separator) {
  std::vector<std::string_view> cells;
  for (std::size_t begin = 0;;) {
    std::size_t end = row.find(separator, begin);
    const std::size_t open = row.find_first_not_of(' ', begin);
    if (open != std::string_view::npos && row[open] == '"')
      if (const std::size_t close = closing_quote(row, open); close != std::string_view::npos)
        end = row.find(separator, close);
    cells.push_back(unquoted(trimmed(row.substr(begin, end - begin))));
    if (end == std::string_view::npos) return cells;
    begin = end + 1;
  }
}

std::string csv_number(std::string_view cell, char separator) {
  std::string text(cell);
  const bool has_point = cell.find('.') != std::string_view::npos;
  if (separator != ',' && !has_point && std::ranges::count(cell, ',') == 1)
    text[cell.find(',')] = '.';
  return text;
}

}  // namespace microswarm
