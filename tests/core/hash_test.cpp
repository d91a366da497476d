// SPDX-License-Identifier: Apache-2.0
#include "microswarm/core/maths/hash.hpp"

#include <gtest/gtest.h>

namespace microswarm {
namespace {

std::uint64_t of_bytes(std::string_view s) {
  Hash hash;
  hash.bytes(std::as_bytes(std::span(s.data(), s.size())));
  return hash.digest();
}

TEST(Hash, MatchesPublishedFnv1a) {
  EXPECT_EQ(of_bytes(""), 0xcbf29ce484222325ULL);
  EXPECT_EQ(of_bytes("a"), 0xaf63dc4c8601ec8cULL);
  EXPECT_EQ(of_bytes("foobar"), 0x85944171f73967e8ULL);
}

TEST(Hash, HexHasSixteenDigits) {
  EXPECT_EQ(Hash().hex(), "cbf29ce484222325");
  Hash hash;
  hash.value(1.5);
  EXPECT_EQ(hash.hex().size(), 16u);
}

TEST(Hash, TellsTextsApartByWhereTheyEnd) {
  Hash a, b;
  a.text("ab");
  a.text("c");
  b.text("a");
  b.text("bc");
  EXPECT_NE(a.digest(), b.digest());
}

TEST(Hash, TakesValuesByTheirBits) {
  Hash a, b;
  a.value(0.0);
  b.value(-0.0);
  EXPECT_NE(a.digest(), b.digest());
}

}  // namespace
}  // namespace microswarm
