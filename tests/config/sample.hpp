// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "microswarm/core/fields/fields.hpp"
#include "microswarm/core/maths/angles.hpp"
#include "microswarm/geometry/vec2.hpp"

namespace microswarm::sample {

/// A declaration with every type that a field may have: for tests and the fuzzer.
enum class Walls { slide, stop };
constexpr auto enum_names(Walls) {
  return std::array<std::pair<Walls, std::string_view>, 2>{
      {{Walls::slide, "slide"}, {Walls::stop, "stop"}}};
}

struct Disc {
  static constexpr std::string_view type_name = "disc";
  double radius = 50;
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.radius, {"radius", Unit::um, {1e-3, 1e6}, "Radius.", true});
  }
  bool operator==(const Disc&) const = default;
};

struct Fan {
  static constexpr std::string_view type_name = "fan";
  double opening = radians(30);
  double turning = 0;
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.opening, {"opening", Unit::deg, {0, 360}, "Angle at its tip."});
    visit(self.turning, {"turning", Unit::deg_per_s, {}, "How fast it turns."});
  }
  bool operator==(const Fan&) const = default;
};

struct Nothing {
  static constexpr std::string_view type_name = "nothing";
  template <class Self, class V>
  static void fields(Self&, V&&) {}
  bool operator==(const Nothing&) const = default;
};

using Shape = std::variant<Disc, Fan, Nothing>;

struct Obstacle {
  Shape shape;
  std::vector<Vec2> way;
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.shape, {"shape", Unit::none, {}, "What it is.", true});
    visit(self.way, {"way", Unit::um, {-1e6, 1e6}, "Where it goes."});
  }
  bool operator==(const Obstacle&) const = default;
};

struct Planner {
  double step = 40;
  int max_nodes = 4000;
  Walls walls = Walls::stop;
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.step, {"step", Unit::um, {1, 1e5}, "Length of one extension."});
    visit(self.max_nodes, {"max_nodes", Unit::none, {1, 1e7}, "Nodes to grow at most."});
    visit(self.walls, {"walls", Unit::none, {}, "What happens at a wall."});
  }
  bool operator==(const Planner&) const = default;
};

struct Scene {
  std::string name = "untitled";
  std::uint64_t seed = 1;
  bool noisy = false;
  Pose2 start;
  Vec2 goal{100, 0};
  Planner planner{.step = 25};
  Shape tip;
  std::optional<double> limit;
  std::optional<Planner> second;
  std::optional<std::string> note = "none yet";
  std::vector<double> times;
  std::vector<std::vector<Vec2>> rings;
  std::vector<Obstacle> obstacles;
  std::vector<Walls> kinds = {Walls::slide};
  int count = 0;
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.name, {"name", Unit::none, {}, "What it is called."});
    visit(self.seed, {"seed", Unit::none, {}, "Seed of all randomness."});
    visit(self.noisy, {"noisy", Unit::none, {}, "Whether the camera shakes."});
    visit(self.start, {"start", Unit::none, {}, "Where it starts."});
    visit(self.goal, {"goal", Unit::um, {-1e6, 1e6}, "Where it shall go."});
    visit(self.planner, {"planner", Unit::none, {}, "How it plans."});
    visit(self.tip, {"tip", Unit::none, {}, "What leads."});
    visit(self.limit, {"limit", Unit::s, {.min = 0}, "When to give up."});
    visit(self.second, {"second", Unit::none, {}, "Another planner."});
    visit(self.note, {"note", Unit::none, {}, "Free text."});
    visit(self.times, {"times", Unit::s, {.max = 1e9}, "When to look."});
    visit(self.rings, {"rings", Unit::um, {}, "Outlines."});
    visit(self.obstacles, {"obstacles", Unit::none, {}, "What is in the way."});
    visit(self.kinds, {"kinds", Unit::none, {}, "Walls in turn."});
    visit(self.count, {"count", Unit::none, {}, "Any whole number."});
  }
  bool operator==(const Scene&) const = default;
};

}  // namespace microswarm::sample
