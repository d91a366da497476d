// SPDX-License-Identifier: Apache-2.0
#include "microswarm/scenes/arena/arena.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <utility>

#include "microswarm/scenes/arena/draft.hpp"

namespace microswarm::scenes {
namespace {

constexpr double arena_tolerance = 30;  // [µm]

const std::vector<ArenaDrawing>& all_drawings() {
  static const std::vector<ArenaDrawing> drawings = [] {
    std::vector<ArenaDrawing> all;
    for (const auto drawn : {still_drawings(), corridor_drawings(), door_drawings(),
                             mover_drawings(), crowd_drawings()})
      all.insert(all.end(), drawn.begin(), drawn.end());
    std::ranges::stable_sort(all, {}, [](const ArenaDrawing& d) { return d.kind.group; });
    return all;
  }();
  return drawings;
}

}  // namespace

void ArenaDraft::wall(Vec2 lo, Vec2 hi) { walls.push_back({lo, {hi.x, lo.y}, hi, {lo.x, hi.y}}); }

void ArenaDraft::lane(double left, double right, double width, double centre) {
  wall({left, 0}, {right, centre - width / 2});
  wall({left, centre + width / 2}, {right, arena_size.y});
}

void ArenaDraft::still_disc(Vec2 at, double radius) { add(DiscShape{radius}, Still{at}); }

void ArenaDraft::disc(Vec2 at, double radius, Vec2 velocity) {
  add(DiscShape{radius}, Straight{at, velocity});
}

const std::vector<ArenaKind>& arena_kinds() {
  static const std::vector<ArenaKind> kinds = [] {
    std::vector<ArenaKind> all;
    for (const ArenaDrawing& drawing : all_drawings()) all.push_back(drawing.kind);
    return all;
  }();
  return kinds;
}

experiment::Scenario arena_scenario(std::size_t kind, std::uint64_t seed) {
  assert(kind < all_drawings().size());
  const ArenaDrawing& drawing = all_drawings()[kind];
  // Each kind has a separate stream, which further kinds do not change.
  std::uint32_t stream = 0;
  for (const char c : drawing.kind.name) stream = 31 * stream + static_cast<unsigned char>(c);
  Rng rng(seed, Purpose::scene, stream);
  ArenaDraft draft(rng);
  drawing.draw(draft);
  experiment::Scenario s;
  s.name = fmt::format("{} {}", drawing.kind.name, seed);
  s.description = drawing.kind.description;
  formats::PolygonsMap map;
  map.hi = arena_size;
  map.walls = std::move(draft.walls);
  s.map = std::move(map);
  s.obstacles = std::move(draft.obstacles);
  s.swarm = draft.swarm;
  s.sensing = draft.sensing;
  s.start = draft.start;
  s.goal = draft.goal;
  s.goal_tolerance = arena_tolerance;
  s.time_limit = 205;
  s.hold_limit = 60;
  s.stop_at_contact = true;
  s.seed = seed;
  return s;
}

}  // namespace microswarm::scenes
