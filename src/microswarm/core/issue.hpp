// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include "microswarm/core/error.hpp"

namespace microswarm {

/// One thing that is wrong with a value.
struct Issue {
  /// That it is about; it is told at the first that is written. None where the text names a file.
  std::vector<std::string> keys;
  std::string text;
};

/// Everything that is wrong with a value. Keys are relative to it and joined by dots, entries of a
/// list are counted from 0: "obstacles.3.shape.radius_um". Checks return issues and know no file;
/// KeyLocations tells where the keys stand.
class Issues {
 public:
  void add(std::initializer_list<std::string_view> keys, std::string text);
  void add(std::string_view key, std::string text) { add({key}, std::move(text)); }
  void add(const Issues& more);
  /// Adds those of what `key` holds; its name in words stands before each text: "obstacle 4".
  void add_within(std::string_view key, const Issues& part, const std::string& words = {});
  /// Drops those that are about anything in one of these keys.
  void drop(const std::vector<std::string>& keys);

  bool empty() const { return list_.empty(); }
  std::size_t size() const { return list_.size(); }
  auto begin() const { return list_.begin(); }
  auto end() const { return list_.end(); }

 private:
  std::vector<Issue> list_;
};

/// Calls `read`, whose InputError is one more issue: about that key, or about none where it names a
/// file.
template <class Read>
void attempt(Issues& issues, std::string_view key, Read&& read) {
  try {
    read();
  } catch (const InputError& error) {
    if (key.empty())
      issues.add({}, error.what());
    else
      issues.add(key, error.what());
  }
}

/// Whether `key` is `outer` or something in it.
bool is_in_key(std::string_view key, std::string_view outer);

/// Whether a key is written somewhere, or has its default.
using IsGiven = std::function<bool(std::string_view key)>;

/// The same for the keys of what `key` holds.
IsGiven given_within(const IsGiven& given, std::string_view key);

}  // namespace microswarm
