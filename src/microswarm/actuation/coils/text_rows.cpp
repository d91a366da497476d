// SPDX-License-Identifier: Apache-2.0
#include "microswarm/actuation/coils/text_rows.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "microswarm/core/error.hpp"
#include "microswarm/core/text.hpp"

namespace microswarm {
namespace {

constexpr std::string_view blanks = " \t\v\f\r";
constexpr std::string_view byte_order_mark = "\xef\xbb\xbf";

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(blanks);
  if (first == text.npos) return {};
  return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

}  // namespace

TextRows::TextRows(std::string_view text, std::string_view name) : rest_(text), name_(name) {
  if (rest_.starts_with(byte_order_mark)) rest_.remove_prefix(byte_order_mark.size());
}

bool TextRows::next() {
  while (!rest_.empty()) {
    ++line_;
    const std::size_t end = std::min(rest_.find('\n'), rest_.size());
    row_ = trimmed(rest_.substr(0, end));
    rest_.remove_prefix(std::min(end + 1, rest_.size()));
    if (!row_.empty() && row_.front() != '#') return true;
  }
  return false;
}

std::vector<std::string_view> TextRows::pieces(char separator) const {
  std::vector<std::string_view> found;
  std::string_view left = row_;
  for (std::size_t end = 0; end != left.npos;) {
    end = separator == ' ' ? left.find_first_of(blanks) : left.find(separator);
    found.push_back(trimmed(left.substr(0, end)));
    if (end != left.npos) left.remove_prefix(end + 1);
    if (separator == ' ') left = trimmed(left);
  }
  return found;
}

double TextRows::number(std::string_view piece, std::string_view what) const {
  const std::optional<double> value = parse_number(piece);
  if (!value) fail(fmt::format("{} is {}, must be a number", what, quote(piece)));
  return *value;
}

std::vector<double> TextRows::numbers(std::size_t count, char separator, const char* what) {
  if (!next()) fail(fmt::format("the file ends where {} should stand", what));
  const std::vector<std::string_view> words = pieces(separator);
  if (words.size() != count)
    fail(fmt::format("{} numbers, {} expected: {}", words.size(), count, what));
  std::vector<double> values;
  values.reserve(count);
  for (const std::string_view word : words) values.push_back(number(word, what));
  return values;
}

void TextRows::end() {
  if (next()) fail("nothing is expected after the last node");
}

void TextRows::fail(const std::string& why) const {
  throw InputError(name_, std::max(line_, 1), 0, why);
}

}  // namespace microswarm
