// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace microswarm::cli {

/// A key of a terminal.
struct Key {
  enum class Kind { character, escape, up, down, left, right, other };
  Kind kind = Kind::character;
  char character = 0;
  friend bool operator==(const Key&, const Key&) = default;
};

/// Takes the keys from what a terminal sent. An arrow or function key is a sequence that begins
/// with ESC; one that is incomplete stays in `input`. `is_all`: nothing follows soon, so that its
/// ESC is the key Esc. An ESC that begins no sequence is the key Esc, too.
std::vector<Key> take_keys(std::string& input, bool is_all);

/// Whether it sets the coils to zero: Esc, space, e.
bool is_emergency(const Key& key);

/// The keys of one moment that are meant: none of a pasted text, which has many different ones. An
/// emergency key always is.
std::vector<Key> meant(const std::vector<Key>& keys);

}  // namespace microswarm::cli
