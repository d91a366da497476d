// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "microswarm/config/former_keys.hpp"
#include "microswarm/config/settings.hpp"
#include "microswarm/config/yaml_node.hpp"
#include "microswarm/core/error.hpp"
#include "microswarm/core/issue.hpp"

namespace microswarm {

/// Where the keys of a parameter file stand, for issues that are found after reading.
class KeyLocations {
 public:
  /// What is looked for: where to complain about a key and all in it; where about something missing
  /// in it; whether the key itself is written there.
  enum class Seek { all_of_it, missing_in_it, itself };
  /// What a complaint begins with: "flight.yaml:12:3"; nothing for a key that is not given.
  using Find = std::function<std::optional<std::string>(std::string_view key, Seek seek)>;

  /// Complaints begin with nothing.
  KeyLocations() = default;
  /// They begin with what `find` says, or with the name. A name alone will do for a location.
  KeyLocations(std::string name, Find find) : name_(std::move(name)), find_(std::move(find)) {}
  KeyLocations(std::string name) : name_(std::move(name)) {}  // NOLINT(google-explicit-constructor)
  KeyLocations(const char* name) : name_(name) {}             // NOLINT(google-explicit-constructor)

  /// The same with notes on the former keys that were read.
  KeyLocations(std::string name, Find find, Notes notes)
      : name_(std::move(name)), find_(std::move(find)), notes_(std::move(notes)) {}

  /// One line for each former key that was read.
  const Notes& notes() const { return notes_; }
  void add_notes(const Notes& notes) { notes_.insert(notes_.end(), notes.begin(), notes.end()); }

  /// Whether a key is written there, not only by way of what it stands in.
  bool given(std::string_view key) const;
  /// The same as a function, which keeps what it needs.
  IsGiven is_given() const;

  /// "flight.yaml:12:3: obstacle 4: WHAT", at the first of the keys that is given; else at what the
  /// first would stand in.
  std::string line(const Issue& issue) const;
  /// Throws InputError with a line for each issue, if there are any.
  void require_none(const Issues& issues) const;
  /// The error for one issue, where it is found while something is opened.
  InputError error(std::string_view key, const std::string& what) const;

 private:
  std::string name_;
  Find find_;
  Notes notes_;
};

/// Where the keys of a document stand: "NAME:LINE:COLUMN" of their values. A key that one of the
/// assignments has set, in whole or in part, or whose alternative it has chosen, stands
/// there: "--set KEY".
KeyLocations locations_of(YamlNode document, const std::string& name, Settings assignments,
                          Notes notes = {});

}  // namespace microswarm
