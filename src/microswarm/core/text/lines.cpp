// SPDX-License-Identifier: Apache-2.0
#include "microswarm/core/text/lines.hpp"

#include <algorithm>

#include "microswarm/core/errors/error.hpp"

namespace microswarm {
namespace {

constexpr std::string_view blanks = " \t\v\f\r";
constexpr std::string_view byte_order_mark = "\xef\xbb\xbf";

}  // namespace

Lines::Lines(std::string_view text, std::string_view name) : rest_(text), name_(name) {
  require_utf8(text, name);
  if (rest_.starts_with(byte_order_mark)) rest_.remove_prefix(byte_order_mark.size());
  // Excel reads a first line "sep=;" as the separator of a table.
  constexpr std::string_view separator_line = "sep=";
  if (rest_.starts_with(separator_line) && rest_.size() > separator_line.size() + 1 &&
      (rest_[separator_line.size() + 1] == '\n' || rest_[separator_line.size() + 1] == '\r'))
    next();
}

std::optional<std::string_view> Lines::next() {
  if (rest_.empty()) return std::nullopt;
  ++number_;
  std::size_t end = 0;
  while (end < rest_.size() && rest_[end] != '\n' && rest_[end] != '\r') ++end;
  const std::string_view line = rest_.substr(0, end);
  rest_.remove_prefix(end);
  const std::size_t behind = std::min(rest_.find_first_not_of('\r'), rest_.size());
  const bool has_lf = behind < rest_.size() && rest_[behind] == '\n';
  rest_.remove_prefix(has_lf ? behind + 1 : std::min<std::size_t>(1, rest_.size()));
  return line;
}

void Lines::fail(const std::string& why) const { throw InputError(name_, number_, 0, why); }

void require_utf8(std::string_view text, std::string_view name) {
  if (text.starts_with("\xff\xfe") || text.starts_with("\xfe\xff"))
    throw InputError(std::string(name), "is a text in UTF-16: save it in UTF-8");
}

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(blanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

std::vector<std::string_view> split(std::string_view text, char separator) {
  std::vector<std::string_view> pieces;
  for (std::size_t end = 0; end != std::string_view::npos;) {
    end = text.find(separator);
    pieces.push_back(trimmed(text.substr(0, end)));
    if (end != std::string_view::npos) text.remove_prefix(end + 1);
  }
  return pieces;
}

std::vector<std::string_view> words(std::string_view text) {
  std::vector<std::string_view> found;
  for (text = trimmed(text); !text.empty(); text = trimmed(text)) {
    const std::size_t end = std::min(text.find_first_of(blanks), text.size());
    found.push_back(text.substr(0, end));
    text.remove_prefix(end);
  }
  return found;
}

}  // namespace microswarm
