// SPDX-License-Identifier: Apache-2.0
#include "microswarm/core/errors/issue.hpp"

#include <algorithm>

namespace microswarm {

void Issues::add(std::initializer_list<std::string_view> keys, std::string text) {
  list_.push_back({{keys.begin(), keys.end()}, std::move(text)});
}

void Issues::add(const Issues& more) {
  list_.insert(list_.end(), more.list_.begin(), more.list_.end());
}

void Issues::add_lines(std::string_view key, std::string_view text) {
  while (true) {
    const std::size_t end = text.find('\n');
    Issue issue{{}, std::string(text.substr(0, end))};
    if (!key.empty()) issue.keys.emplace_back(key);
    list_.push_back(std::move(issue));
    if (end == text.npos) return;
    text.remove_prefix(end + 1);
  }
}

void Issues::add_within(std::string_view key, const Issues& part, const std::string& words) {
  for (Issue issue : part) {
    for (std::string& inner : issue.keys)
      inner = inner.empty() ? std::string(key) : std::string(key) + "." + inner;
    if (!words.empty()) issue.text.insert(0, words + ": ");
    list_.push_back(std::move(issue));
  }
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
