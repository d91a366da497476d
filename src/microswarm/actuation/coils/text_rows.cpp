// SPDX-License-Identifier: Apache-2.0
#include "microswarm/actuation/coils/text_rows.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/text/text.hpp"

namespace microswarm::actuation {

TextRows::TextRows(std::string_view text, std::string_view name)
    : lines_(text, name), name_(name) {}

bool TextRows::next() {
  while (const auto line = lines_.next()) {
    row_ = trimmed(*line);
    if (!row_.empty() && row_.front() != '#') return true;
  }
  return false;
}

std::vector<std::string_view> TextRows::pieces(char separator) const {
  return separator == ' ' ? words(row_) : split(row_, separator);
}

double TextRows::number(std::string_view piece, std::string_view what) const {
  const std::optional<double> value = parse_number(piece);
  if (!value) fail(fmt::format("{} is {}, must be a number", what, quote(piece)));
  return *value;
}

std::vector<double> TextRows::numbers(std::size_t count, char separator, const char* what) {
  if (!next()) fail(fmt::format("the file ends where {} should stand", what));
  const std::vector<std::string_view> found = pieces(separator);
  if (found.size() != count)
    fail(fmt::format("{} numbers, {} expected: {}", found.size(), count, what));
  std::vector<double> values;
  values.reserve(count);
  for (const std::string_view piece : found) values.push_back(number(piece, what));
  return values;
}

void TextRows::end() {
  if (next()) fail("nothing is expected after the last node");
}

void TextRows::fail(const std::string& why) const {
  throw InputError(name_, std::max(line(), 1), 0, why);
}

}  // namespace microswarm::actuation
