// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include "microswarm/core/errors/error.hpp"

namespace microswarm {

/// One mistake in a value.
struct Issue {
  /// Keys concerned; the message locates the first one present in the file. Empty if the text names
  /// a file itself.
  std::vector<std::string> keys;
  std::string text;
};

/// List of all mistakes in a value. Keys are relative to it and joined by dots; list entries count
/// from 0: "obstacles.3.shape.radius_um". Validation returns issues and knows no file; KeyLocations
/// adds the file positions.
class Issues {
 public:
  void add(std::initializer_list<std::string_view> keys, std::string text);
  void add(std::string_view key, std::string text) { add({key}, std::move(text)); }
  void add(const Issues& more);
  /// Adds an issue about `key` for each line of the text; an empty key means the text names a file.
  void add_lines(std::string_view key, std::string_view text);
  /// Adds the issues of the part held by `key`; `words` (e.g. "obstacle 4") is put before each
  /// text.
  void add_within(std::string_view key, const Issues& part, const std::string& words = {});
  /// Removes issues about any of these keys or anything within them.
  void drop(const std::vector<std::string>& keys);

  bool empty() const { return list_.empty(); }
  std::size_t size() const { return list_.size(); }
  auto begin() const { return list_.begin(); }
  auto end() const { return list_.end(); }

 private:
  std::vector<Issue> list_;
};

/// Calls `read` and adds the lines of its InputError as issues about `key`; an empty key means the
/// text names a file.
template <class Read>
void attempt(Issues& issues, std::string_view key, Read&& read) {
  try {
    read();
  } catch (const InputError& error) {
    issues.add_lines(key, error.what());
  }
}

/// Whether `key` is `outer` or lies within it.
bool is_in_key(std::string_view key, std::string_view outer);

/// Returns whether a key is given explicitly rather than left at its default.
using IsGiven = std::function<bool(std::string_view key)>;

/// The same for keys relative to `key`.
IsGiven given_within(const IsGiven& given, std::string_view key);

}  // namespace microswarm
