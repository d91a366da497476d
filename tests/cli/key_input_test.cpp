// SPDX-License-Identifier: Apache-2.0
#include "rig/keys/key_input.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <string>
#include <vector>

namespace microswarm::test {
namespace {

using cli::Key;
using cli::take_keys;
using Kind = cli::Key::Kind;

std::vector<Kind> kinds_of(std::string input, bool is_all = true) {
  std::vector<Kind> kinds;
  for (const Key& key : take_keys(input, is_all)) kinds.push_back(key.kind);
  return kinds;
}

TEST(KeyInput, SequencesAreKeysAndALoneEscIsEsc) {
  EXPECT_EQ(kinds_of("\x1b[A\x1b[B\x1bOC\x1bOD"),
            (std::vector{Kind::up, Kind::down, Kind::right, Kind::left}));
  EXPECT_EQ(kinds_of("\x1b[1;5A\x1b[15~\x1bOP"), (std::vector{Kind::up, Kind::other, Kind::other}));
  EXPECT_EQ(kinds_of("\x1b"), std::vector{Kind::escape});
  EXPECT_EQ(kinds_of("\x1b\x1b"), (std::vector{Kind::escape, Kind::escape}));
  EXPECT_EQ(kinds_of("\x1bp"), (std::vector{Kind::escape, Kind::character}));
  EXPECT_EQ(kinds_of("\x1b["), (std::vector{Kind::escape, Kind::character}));
  EXPECT_EQ(kinds_of("\x1b[" + std::string(100, '1')).front(), Kind::escape);
}

TEST(KeyInput, WhatIsIncompleteStaysUntilNothingFollows) {
  std::string input = "p\x1b";
  EXPECT_EQ(take_keys(input, false), std::vector{Key({Kind::character, 'p'})});
  EXPECT_EQ(input, "\x1b");
  input += "[A";
  EXPECT_EQ(take_keys(input, false), std::vector{Key{Kind::up}});
  EXPECT_EQ(input, "");
}

TEST(KeyInput, AnyBytesInAnyPiecesAreTheSameKeys) {
  std::mt19937 random(3);
  const std::string letters = "\x1b[OAD~1; ep\x07\xff";
  for (int k = 0; k < 20'000; ++k) {
    std::string bytes;
    for (std::size_t n = random() % 40; bytes.size() < n;)
      bytes += letters[random() % letters.size()];
    std::string whole = bytes;
    const std::vector<Key> keys = take_keys(whole, true);
    ASSERT_EQ(whole, "");
    std::vector<Key> pieces;
    std::string input;
    for (const char byte : bytes) {
      input += byte;
      const std::vector<Key> more = take_keys(input, false);
      pieces.insert(pieces.end(), more.begin(), more.end());
      ASSERT_LT(input.size(), 32u);
    }
    const std::vector<Key> rest = take_keys(input, true);
    pieces.insert(pieces.end(), rest.begin(), rest.end());
    ASSERT_EQ(pieces, keys) << k;
    ASSERT_EQ(std::ranges::any_of(cli::meant(keys), cli::is_emergency),
              std::ranges::any_of(keys, cli::is_emergency));
  }
}

TEST(KeyInput, APasteIsNotMeantButItsEmergencyKeyIs) {
  std::string fingers = "pm\x1b[A", repeated = "\x1b[A\x1b[A\x1b[A\x1b[A\x1b[A", paste = "mpqwasd",
              stop = "map, please";
  EXPECT_EQ(cli::meant(take_keys(fingers, true)).size(), 3u);
  EXPECT_EQ(cli::meant(take_keys(repeated, true)).size(), 5u);
  EXPECT_TRUE(cli::meant(take_keys(paste, true)).empty());
  EXPECT_TRUE(std::ranges::all_of(cli::meant(take_keys(stop, true)), cli::is_emergency));
}

}  // namespace
}  // namespace microswarm::test
