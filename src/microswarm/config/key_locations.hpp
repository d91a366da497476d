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
#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/errors/issue.hpp"

namespace microswarm {

/// Places of the keys of a parameter file, for issues found after reading.
class KeyLocations {
 public:
  /// Kind of location: of a key or anything in it; for reporting something missing in it; of the
  /// key itself, only if it is given.
  enum class Seek { all_of_it, missing_in_it, itself };
  /// Place of a key: "flight.yaml:12:3"; nothing for a key that is not given.
  using Find = std::function<std::optional<std::string>(std::string_view key, Seek seek)>;

  /// Locates nothing.
  KeyLocations() = default;
  /// The location of an issue is that from `find`, or `name`. A name alone can serve as
  /// KeyLocations.
  KeyLocations(std::string name, Find find) : name_(std::move(name)), find_(std::move(find)) {}
  KeyLocations(std::string name) : name_(std::move(name)) {}  // NOLINT(google-explicit-constructor)
  KeyLocations(const char* name) : name_(name) {}             // NOLINT(google-explicit-constructor)

  /// The same with notes on the former keys read.
  KeyLocations(std::string name, Find find, Notes notes)
      : name_(std::move(name)), find_(std::move(find)), notes_(std::move(notes)) {}

  /// Notes on the former keys read, one line each.
  const Notes& notes() const { return notes_; }
  void add_notes(const Notes& notes) { notes_.insert(notes_.end(), notes.begin(), notes.end()); }

  /// Whether the key itself is given, not only a key that contains it.
  bool given(std::string_view key) const;
  /// The same as a function that owns a copy.
  IsGiven is_given() const;

  /// The issue with its location: that of the first key that is given, else of the nearest
  /// enclosing key of the first one. An issue without a key, or with a location, stays as it is.
  Issue located(Issue issue) const;
  Issues located(const Issues& issues) const;
  /// Throws InputError with the issues, located, if any.
  void require_none(const Issues& issues) const;
  /// InputError for one issue found while something is opened.
  InputError error(std::string_view key, const std::string& what) const;

 private:
  std::string locate(const std::vector<std::string>& keys) const;

  std::string name_;
  Find find_;
  Notes notes_;
};

/// Locations of a document's keys: "NAME:LINE:COLUMN" of their values. A key has the location
/// "--set KEY" if an assignment set it in whole or in part or chose its alternative.
KeyLocations find_locations(YamlNode document, const std::string& name, Settings assignments,
                            Notes notes = {});

}  // namespace microswarm
