// SPDX-License-Identifier: Apache-2.0
#include "microswarm/core/fields/fields.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace microswarm {
namespace {

enum class Walls { slide, stop };
constexpr auto enum_names(Walls) {
  return std::array<std::pair<Walls, std::string_view>, 2>{
      {{Walls::slide, "slide"}, {Walls::stop, "stop"}}};
}

struct Params {
  double step = 40;
  Walls walls = Walls::stop;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor&& visit) {
    visit(self.step, um("step", 1, 1e5, "Length of one extension."));
    visit(self.walls, plain("walls", "What happens at a wall.").needed());
  }
};

struct Plain {};

static_assert(HasFields<Params> && !HasFields<Plain>);
static_assert(NamedEnum<Walls> && !NamedEnum<Unit>);
static_assert(enum_name(Walls::slide) == "slide" && enum_name(static_cast<Walls>(7)).empty());
static_assert(enum_value<Walls>("stop") == Walls::stop && !enum_value<Walls>("stopp"));

TEST(Fields, AreVisitedInOrderAndByReference) {
  Params params;
  std::vector<std::string> names;
  Params::fields(params, [&](auto& value, const FieldInfo& info) {
    names.emplace_back(info.name);
    if constexpr (std::is_same_v<decltype(value), double&>) value = 60;
  });
  EXPECT_EQ(names, (std::vector<std::string>{"step", "walls"}));
  EXPECT_EQ(params.step, 60);

  const Params fixed;
  Params::fields(fixed, [&](const auto&, const FieldInfo& info) {
    EXPECT_EQ(info.required, info.name == "walls");
    if (info.name == "step") {
      EXPECT_EQ(info.range.max, 1e5);
    }
  });
}

}  // namespace
}  // namespace microswarm
