// SPDX-License-Identifier: Apache-2.0
#include "rig/keys/key_input.hpp"

#include <algorithm>
#include <string_view>

namespace microswarm::cli {
namespace {

constexpr char esc = '\x1b';

Key arrow_key(char final) {
  switch (final) {
    case 'A':
      return {Key::Kind::up};
    case 'B':
      return {Key::Kind::down};
    case 'C':
      return {Key::Kind::right};
    case 'D':
      return {Key::Kind::left};
    default:
      return {Key::Kind::other};
  }
}

/// A sequence that begins with ESC: length and key; the length is 0 if it is incomplete.
struct Sequence {
  std::size_t length = 0;
  Key key{};
};

constexpr Sequence lone_escape{1, {Key::Kind::escape}};

/// Parses ESC [ parameters final, or ESC O final.
Sequence parse_sequence(std::string_view text) {
  constexpr std::size_t longest = 32;
  if (text.size() < 2) return {};
  if (text[1] != '[' && text[1] != 'O') return lone_escape;
  for (std::size_t i = 2; i < std::min(text.size(), longest); ++i) {
    const char byte = text[i];
    if (byte >= 0x40 && byte < 0x7F) return {i + 1, arrow_key(byte)};
    if (byte < 0x20 || byte > 0x3F) return lone_escape;
  }
  return text.size() < longest ? Sequence{} : lone_escape;
}

}  // namespace

std::vector<Key> take_keys(std::string& input, bool is_all) {
  std::vector<Key> keys;
  std::size_t at = 0;
  while (at < input.size()) {
    if (input[at] != esc) {
      keys.push_back({Key::Kind::character, input[at++]});
      continue;
    }
    Sequence sequence = parse_sequence(std::string_view(input).substr(at));
    if (sequence.length == 0 && !is_all) break;
    if (sequence.length == 0) sequence = lone_escape;
    keys.push_back(sequence.key);
    at += sequence.length;
  }
  input.erase(0, at);
  return keys;
}

bool is_emergency(const Key& key) {
  return key.kind == Key::Kind::escape ||
         (key.kind == Key::Kind::character &&
          (key.character == ' ' || key.character == 'e' || key.character == 'E'));
}

std::vector<Key> meant(const std::vector<Key>& keys) {
  constexpr std::size_t most = 3;  // different keys pressed at the same time
  std::vector<Key> different;
  for (const Key& key : keys)
    if (std::ranges::find(different, key) == different.end()) different.push_back(key);
  if (different.size() <= most) return keys;
  std::erase_if(different, [](const Key& key) { return !is_emergency(key); });
  return different;
}

}  // namespace microswarm::cli
