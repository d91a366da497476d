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

/// Extracts keys from a terminal's input. An arrow or function key is a sequence that begins with
/// ESC; an incomplete one stays in `input`, unless `is_all` says that nothing follows soon, so that
/// its ESC is the key Esc. An ESC that begins no sequence is the key Esc too.
std::vector<Key> take_keys(std::string& input, bool is_all);

/// Whether it sets the coils to zero: Esc, space, e.
bool is_emergency(const Key& key);

/// Intended keys among those that arrived together: none of a pasted text, recognised by many
/// different keys, except emergency keys.
std::vector<Key> meant(const std::vector<Key>& keys);

}  // namespace microswarm::cli
