// SPDX-License-Identifier: Apache-2.0
#include "microswarm/core/text/csv.hpp"

#include <algorithm>

#include "microswarm/core/text/lines.hpp"

namespace microswarm {

char csv_separator(std::string_view header) {
  for (const char separator : {',', ';', '\t'})
    if (header.find(separator) != std::string_view::npos) return separator;
  return ',';
}

std::vector<std::string_view> csv_cells(std::string_view row, char separator) {
  std::vector<std::string_view> cells = split(row, separator);
  for (std::string_view& cell : cells)
    if (cell.size() > 1 && cell.front() == '"' && cell.back() == '"')
      cell = trimmed(cell.substr(1, cell.size() - 2));
  return cells;
}

std::string csv_number(std::string_view cell, char separator) {
  std::string text(cell);
  const bool has_point = cell.find('.') != std::string_view::npos;
  if (separator != ',' && !has_point && std::ranges::count(cell, ',') == 1)
    text[cell.find(',')] = '.';
  return text;
}

}  // namespace microswarm
