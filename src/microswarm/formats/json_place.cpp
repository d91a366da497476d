// SPDX-License-Identifier: Apache-2.0
#include "microswarm/formats/json_place.hpp"

#include <algorithm>

namespace microswarm::formats {
namespace {

/// Scans valid JSON without building a tree.
class Scanner {
 public:
  explicit Scanner(std::string_view json) : json_(json) {}

  /// Position of the value at `place`, or of its nearest existing ancestor.
  std::size_t find(const JsonPlace& place) {
    if (!place.parent) return begin_ = value_after(0);
    begin_ = find(*place.parent);
    if (lost_) return begin_;
    const std::size_t child = place.key.empty() ? entry(place.index) : member(place.key);
    lost_ = child == json_.size();
    return lost_ ? begin_ : child;
  }

 private:
  /// First byte at or after `at` that is neither blank nor separator.
  std::size_t value_after(std::size_t at) const {
    return std::min(json_.find_first_not_of(" \t\r\n,:", at), json_.size());
  }

  std::size_t after_string(std::size_t at) const {
    for (++at; at < json_.size() && json_[at] != '"'; ++at)
      if (json_[at] == '\\') ++at;
    return std::min(at + 1, json_.size());
  }

  std::size_t after_value(std::size_t at) const {
    if (at >= json_.size()) return json_.size();
    if (json_[at] == '"') return after_string(at);
    if (json_[at] != '{' && json_[at] != '[')
      return std::min(json_.find_first_of(" \t\r\n,:]}", at), json_.size());
    int depth = 0;
    while (at < json_.size()) {
      const char c = json_[at];
      if (c == '"') {
        at = after_string(at);
        continue;
      }
      depth += c == '{' || c == '[' ? 1 : c == '}' || c == ']' ? -1 : 0;
      ++at;
      if (depth == 0) break;
    }
    return at;
  }

  bool ends(std::size_t at) const {
    return at >= json_.size() || json_[at] == ']' || json_[at] == '}';
  }

  std::size_t entry(std::size_t index) const {
    std::size_t at = value_after(begin_ + 1);
    for (; !ends(at) && index > 0; --index) at = value_after(after_value(at));
    return ends(at) ? json_.size() : at;
  }

  std::size_t member(std::string_view key) const {
    std::size_t found = json_.size();
    for (std::size_t at = value_after(begin_ + 1); !ends(at);) {
      const std::size_t end = after_value(at);
      const std::size_t value = value_after(end);
      if (end - at == key.size() + 2 && json_.substr(at + 1, key.size()) == key) found = value;
      at = value_after(after_value(value));
    }
    return found;
  }

  std::string_view json_;
  std::size_t begin_ = 0;
  bool lost_ = false;
};

}  // namespace

std::string JsonPlace::text() const {
  if (!parent) return {};
  std::string path = parent->text();
  if (key.empty()) return path + "[" + std::to_string(index) + "]";
  return path.empty() ? std::string(key) : path + "." + std::string(key);
}

int line_number(std::string_view json, const JsonPlace& place) {
  const std::size_t at = Scanner(json).find(place);
  return 1 + static_cast<int>(
                 std::count(json.begin(), json.begin() + static_cast<std::ptrdiff_t>(at), '\n'));
}

}  // namespace microswarm::formats
