// SPDX-License-Identifier: Apache-2.0
#include "microswarm/core/fields/overloaded.hpp"

#include <gtest/gtest.h>

#include <type_traits>
#include <variant>

namespace microswarm {
namespace {

struct Round {
  int corners = 0;
};
struct Square {
  int corners = 4;
};
struct Tilted : Square {};
using Shape = std::variant<Round, Square, Tilted>;

int corners_of(const Shape& shape) {
  return std::visit(Overloaded{[](const Round&) { return 0; },
                               [](const OneOf<Square, Tilted> auto& s) { return s.corners; }},
                    shape);
}

TEST(Overloaded, EachAlternativeHasItsOwn) {
  EXPECT_EQ(corners_of(Round{}), 0);
  EXPECT_EQ(corners_of(Square{}), 4);
  EXPECT_EQ(corners_of(Tilted{}), 4);
}

TEST(Overloaded, AnAlternativeMayBeChanged) {
  Shape shape = Tilted{};
  std::visit(Overloaded{[](Round& round) { round.corners = 1; },
                        [](OneOf<Square, Tilted> auto& s) { s.corners = 5; }},
             shape);
  EXPECT_EQ(corners_of(shape), 5);
}

// What is forgotten does not compile: not as its base, by a conversion, or by a generic overload.
constexpr auto square = [](const Square&) { return 4; };
constexpr auto number = [](double) { return 1; };
constexpr auto anything = [](const auto&) { return 0; };
template <class... Overloads>
using All = Overloaded<std::remove_const_t<Overloads>...>;
static_assert(std::is_invocable_v<All<decltype(square)>, const Square&>);
static_assert(std::is_invocable_v<All<decltype(square)>, Square&>);
static_assert(!std::is_invocable_v<All<decltype(square)>, const Round&>);
static_assert(!std::is_invocable_v<All<decltype(square)>, const Tilted&>);
static_assert(std::is_invocable_v<All<decltype(number)>, double>);
static_assert(!std::is_invocable_v<All<decltype(number)>, int>);
static_assert(!std::is_invocable_v<All<decltype(square), decltype(anything)>, const Round&>);

}  // namespace
}  // namespace microswarm
