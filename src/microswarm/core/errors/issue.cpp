// SPDX-License-Identifier: Apache-2.0
#include "microswarm/core/errors/issue.hpp"

#include <algorithm>

namespace microswarm {

std::string to_string(const Issue& issue) {
  return issue.location.empty() ? issue.text : issue.location + ": " + issue.text;
}

std::string to_string(const Issues& issues) {
  constexpr std::size_t most = 20;
  std::string text;
  for (std::size_t i = 0; i < std::min(issues.size(), most); ++i)
    text += (i == 0 ? "" : "\n") + to_string(issues[i]);
  if (issues.size() > most)
    text += (issues.size() < max_issues ? "\nand " : "\nand at least ") +
            std::to_string(issues.size() - most) + " more";
  return text;
}

void Issues::add(std::initializer_list<std::string_view> keys, std::string text) {
  list_.push_back({{keys.begin(), keys.end()}, std::move(text)});
}

void Issues::add(const Issues& more) {
  list_.insert(list_.end(), more.list_.begin(), more.list_.end());
}

void Issues::add_within(std::string_view key, const Issues& part, const std::string& words) {
  for (Issue issue : part) {
    for (std::string& inner : issue.keys)
      inner = inner.empty() ? std::string(key) : std::string(key) + "." + inner;
    if (!words.empty()) issue.text.insert(0, words + ": ");
    list_.push_back(std::move(issue));
  }
}

void Issues::add_about(std::string_view key, const Issues& of_file) {
  for (const Issue& issue : of_file)
    list_.push_back({{std::string(key)}, to_string(issue), {}, issue.value, issue.limit});
}

Issues Issues::placed_in(std::string_view outer) const {
  Issues same = *this;
  for (Issue& issue : same.list_)
    issue.location = std::string(outer) + (issue.location.empty() ? "" : ": ") + issue.location;
  return same;
}

Issues Issues::unplaced() const {
  Issues same = *this;
  for (Issue& issue : same.list_) issue.location.clear();
  return same;
}

void Issues::drop(const std::vector<std::string>& keys) {
  std::erase_if(list_, [&](const Issue& issue) {
    return std::ranges::any_of(issue.keys, [&](const std::string& key) {
      return std::ranges::any_of(keys,
                                 [&](const std::string& outer) { return is_in_key(key, outer); });
    });
  });
}

bool is_in_key(std::string_view key, std::string_view outer) {
  return key.starts_with(outer) && (key.size() == outer.size() || key[outer.size()] == '.');
}

IsGiven given_within(const IsGiven& given, std::string_view key) {
  if (!given) return {};
  return [given, outer = std::string(key) + "."](std::string_view inner) {
    return given(outer + std::string(inner));
  };
}

}  // namespace microswarm
