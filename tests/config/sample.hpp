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
    visit(self.radius, um("radius", 1e-3, 1e6, "Radius.").needed());
  }
  bool operator==(const Disc&) const = default;
};

struct Fan {
  static constexpr std::string_view type_name = "fan";
  double opening = radians(30);
  double turning = 0;
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.opening, deg("opening", 0, 360, "Angle at its tip."));
    visit(self.turning, deg_per_s("turning", "How fast it turns."));
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
    visit(self.shape, plain("shape", "What it is.").needed());
    visit(self.way, um("way", -1e6, 1e6, "Where it goes."));
  }
  bool operator==(const Obstacle&) const = default;
};

struct Planner {
  double step = 40;
  int max_nodes = 4000;
  Walls walls = Walls::stop;
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.step, um("step", 1, 1e5, "Length of one extension."));
    visit(self.max_nodes, plain("max_nodes", 1, 1e7, "Nodes to grow at most."));
    visit(self.walls, plain("walls", "What happens at a wall."));
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
    visit(self.name, plain("name", "What it is called."));
    visit(self.seed, plain("seed", "Seed of all randomness."));
    visit(self.noisy, plain("noisy", "Whether the camera shakes."));
    visit(self.start, plain("start", "Where it starts."));
    visit(self.goal, um("goal", -1e6, 1e6, "Where it shall go."));
    visit(self.planner, plain("planner", "How it plans."));
    visit(self.tip, plain("tip", "What leads."));
    visit(self.limit, s("limit", Range{.min = 0}, "When to give up."));
    visit(self.second, plain("second", "Another planner."));
    visit(self.note, plain("note", "Free text."));
    visit(self.times, s("times", Range{.max = 1e9}, "When to look."));
    visit(self.rings, um("rings", "Outlines."));
    visit(self.obstacles, plain("obstacles", "What is in the way."));
    visit(self.kinds, plain("kinds", "Walls in turn."));
    visit(self.count, plain("count", "Any whole number."));
  }
  bool operator==(const Scene&) const = default;
};

}  // namespace microswarm::sample
