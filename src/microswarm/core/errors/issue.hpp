// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

namespace microswarm {

/// One mistake in a value.
struct Issue {
  /// Keys concerned; the first one present in the file gives the location. Empty if no key is.
  std::vector<std::string> keys{};
  std::string text{};
  /// Place where the value was given, in words of who gave it: "flight.yaml:12:3", "--set seed", a
  /// file. Empty as long as it is not located.
  std::string location{};
  std::string value{};  ///< the value as written, cut if it is long; empty if unknown
  std::string limit{};  ///< what is allowed: "1..1e5 µm", "slide, stop"; empty if unknown
};

/// "PLACE: TEXT", or the text alone.
std::string to_string(const Issue& issue);

/// List of all mistakes in a value. Keys are relative to it and joined by dots; list entries count
/// from 0: "obstacles.3.shape.radius_um". Validation returns issues and knows no file; KeyLocations
/// adds the locations.
class Issues {
 public:
  void add(Issue issue) { list_.push_back(std::move(issue)); }
  void add(std::initializer_list<std::string_view> keys, std::string text);
  void add(std::string_view key, std::string text) { add({key}, std::move(text)); }
  void add(const Issues& more);
  /// Adds the issues of the part held by `key`; `words` (e.g. "obstacle 4") is put before each
  /// text.
  void add_within(std::string_view key, const Issues& part, const std::string& words = {});
  /// Adds the issues of a file or text that `key` names: their locations become part of the texts.
  void add_about(std::string_view key, const Issues& of_file);
  /// The same issues, with `outer` before their locations: "sweep.yaml: --set seed".
  Issues placed_in(std::string_view outer) const;
  /// The same issues without locations, for one who gave the key.
  Issues unplaced() const;
  /// Removes issues about any of these keys or anything within them.
  void drop(const std::vector<std::string>& keys);

  bool empty() const { return list_.empty(); }
  std::size_t size() const { return list_.size(); }
  const Issue& operator[](std::size_t i) const { return list_[i]; }
  auto begin() const { return list_.begin(); }
  auto end() const { return list_.end(); }

 private:
  std::vector<Issue> list_;
};

/// Mistakes that a reader of a file looks for at most; it ends at the last of them.
inline constexpr std::size_t max_issues = 1000;

/// One line for each issue; only the first 20 are listed, the rest are counted.
std::string to_string(const Issues& issues);

/// Whether `key` is `outer` or lies within it.
bool is_in_key(std::string_view key, std::string_view outer);

/// Returns whether a key is given explicitly rather than left at its default.
using IsGiven = std::function<bool(std::string_view key)>;

/// The same for keys relative to `key`.
IsGiven given_within(const IsGiven& given, std::string_view key);

}  // namespace microswarm
