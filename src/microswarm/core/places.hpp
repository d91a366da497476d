// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "microswarm/core/error.hpp"

namespace microswarm {

/// Where the keys of a parameter file stand, for complaints that can only be made after reading:
/// about several keys, or a key on a map. Keys are joined by dots, a list's entries counted from 0:
/// "obstacles.3.shape.radius_um".
class Places {
 public:
  /// What is looked for: where to complain about a key and all in it; where about something missing
  /// in it; whether the key itself is written there.
  enum class Seek { all_of_it, missing_in_it, itself };
  /// What a complaint begins with: "flight.yaml:12:3"; nothing for a key that is not given.
  using Find = std::function<std::optional<std::string>(std::string_view key, Seek seek)>;

  /// Complaints begin with nothing.
  Places() = default;
  /// They begin with what `find` says, or with the name. A name alone will do for a place.
  Places(std::string name, Find find) : name_(std::move(name)), find_(std::move(find)) {}
  Places(std::string name) : name_(std::move(name)) {}  // NOLINT(google-explicit-constructor)
  Places(const char* name) : name_(name) {}             // NOLINT(google-explicit-constructor)

  /// The same for what is within a key; its name in words stands before each complaint:
  /// "obstacle 4".
  Places within(std::string_view key, const std::string& words = {}) const;

  /// Whether a key is written there, not only by way of what it stands in.
  bool given(std::string_view key) const;
  /// "flight.yaml:12:3: obstacle 4: WHAT", at the first of the keys that is given; else at what the
  /// first would stand in.
  InputError error(std::initializer_list<std::string_view> keys, const std::string& what) const;
  InputError error(std::string_view key, const std::string& what) const {
    return error({key}, what);
  }
  /// What stands before the complaint there.
  std::string before(std::initializer_list<std::string_view> keys) const;

 private:
  std::string name_;
  Find find_;
  std::string prefix_;  // of keys
  std::string words_;
};

}  // namespace microswarm
