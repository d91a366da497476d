// SPDX-License-Identifier: Apache-2.0
#include "microswarm/core/text/csv.hpp"

#include <algorithm>
#include <cstddef>
#include <optional>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/text/lines.hpp"
#include "microswarm/core/text/text.hpp"

namespace microswarm {
namespace {

/// Place of the quote that ends a quoted cell: the first that is not doubled; npos without one.
std::size_t closing_quote(std::string_view row, std::size_t open) {
  std::size_t at = row.find('"', open + 1);
  while (at != std::string_view::npos && row.substr(at + 1).starts_with('"'))
    at = row.find('"', at + 2);
  return at;
}

/// Form of the number in a cell.
enum class NumberForm {
  none,     ///< no number
  whole,    ///< without a point and a comma
  point,    ///< with a decimal point
  decimal,  ///< with a comma that can only be decimal
  either    ///< "1,010"
};

NumberForm form_of(std::string_view cell) {
  const std::size_t comma = cell.find(',');
  if (comma == std::string_view::npos) {
    if (!parse_number(cell)) return NumberForm::none;
    return cell.find('.') == std::string_view::npos ? NumberForm::whole : NumberForm::point;
  }
  std::string text(cell);
  text[comma] = '.';
  if (!parse_number(text)) return NumberForm::none;
  const std::size_t first = cell.front() == '-' || cell.front() == '+' ? 1 : 0;
  const bool is_group = comma > first && comma - first <= 3 && cell[first] != '0' &&
                        cell.size() - comma - 1 == 3 &&
                        cell.find_first_not_of("0123456789", comma + 1) == std::string_view::npos;
  return is_group ? NumberForm::either : NumberForm::decimal;
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

void require_clear_commas(std::string_view text, std::string_view name, char separator) {
  // Between commas only a quoted cell holds one.
  if (text.find(separator == ',' ? '"' : ',') == std::string_view::npos) return;
  bool has_point = false, has_whole = false, has_decimal = false;
  int line_of_either = 0;
  std::string either;
  Lines lines(text, name);
  while (const std::optional<std::string_view> line = lines.next()) {
    if (trimmed(*line).starts_with('#')) continue;
    for (const std::string_view cell : csv_cells(*line, separator)) {
      const NumberForm form = form_of(cell);
      has_point = has_point || form == NumberForm::point;
      has_whole = has_whole || form == NumberForm::whole;
      has_decimal = has_decimal || form == NumberForm::decimal;
      if (form != NumberForm::either || line_of_either > 0) continue;
      line_of_either = lines.number();
      either = cell;
    }
  }
  const bool may_be_thousands =
      has_point || (!has_decimal && (separator == ',' || (separator == '\t' && has_whole)));
  if (line_of_either == 0 || !may_be_thousands) return;
  std::string as_decimal = either, as_thousands = either;
  as_decimal[either.find(',')] = '.';
  as_thousands.erase(either.find(','), 1);
  throw InputError(std::string(name), line_of_either, 0,
                   quote(either) + " may be " + number_text(*parse_number(as_thousands)) + " or " +
                       number_text(*parse_number(as_decimal)) +
                       ": write thousands without a comma, and decimals in one way");
}

}  // namespace microswarm
