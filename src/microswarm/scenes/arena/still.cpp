// SPDX-License-Identifier: Apache-2.0
// Scenes in which nothing moves but the swarm.
#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>
#include <vector>

#include "microswarm/core/maths/angles.hpp"
#include "microswarm/geometry/vec2.hpp"
#include "microswarm/scenes/arena/draft.hpp"

namespace microswarm::scenes {
namespace {

constexpr ArenaGroup still = ArenaGroup::still;

void empty_room(ArenaDraft& d) { d.shift_start(400); }

void start_at_wall(ArenaDraft& d) {
  d.wall({500, 300}, {560, 900});
  d.start = {{500 - arena_radius - d.uniform(0.5, 8), arena_middle + d.uniform(-200, 200)}, pi};
}

void goal_at_wall(ArenaDraft& d) {
  d.wall({1400, 300}, {1460, 900});
  d.shift_start(200);
  d.goal = {1400 - arena_radius - d.uniform(1, 6), arena_middle};
}

void goal_in_pocket(ArenaDraft& d) {
  const double half = d.uniform(58, 75);
  d.wall({1300, arena_middle - half - 60}, {1600, arena_middle - half});
  d.wall({1300, arena_middle + half}, {1600, arena_middle + half + 60});
  d.wall({1540, arena_middle - half - 60}, {1600, arena_middle + half + 60});
  d.start = {{d.uniform(1660, 1900), arena_middle}, pi};
  d.goal = {1470, arena_middle};
}

void u_trap(ArenaDraft& d) {
  const double centre = arena_middle + d.uniform(-80, 80);
  const double left = d.uniform(700, 900);
  d.wall({1300, centre - 350}, {1360, centre + 350});
  d.wall({left, centre - 350}, {1360, centre - 290});
  d.wall({left, centre + 290}, {1360, centre + 350});
}

void two_traps(ArenaDraft& d) {
  for (const double right : {850.0, 1500.0}) {
    const double centre = arena_middle + d.uniform(-100, 100);
    d.wall({right, centre - 300}, {right + 50, centre + 300});
    d.wall({right - 350, centre - 300}, {right + 50, centre - 250});
    d.wall({right - 350, centre + 250}, {right + 50, centre + 300});
  }
}

void spiral(ArenaDraft& d) {
  const double lane = d.uniform(150, 190);
  constexpr double thick = 40;
  double left = 300, right = 1700, low = 200, high = 1100;
  d.wall({left, low}, {right, low + thick});
  // Round after round, each wall ends a lane before the one that was drawn before it.
  for (int round = 0; round < 2; ++round) {
    d.wall({right - thick, low}, {right, high});
    d.wall({left, high - thick}, {right, high});
    d.wall({left, low + thick + lane}, {left + thick, high});
    low += thick + lane;
    right -= thick + lane;
    d.wall({left, low}, {right, low + thick});
    high -= thick + lane;
    left += thick + lane;
  }
  d.start = {{150, 200 + thick + lane / 2}, 0};
  d.goal = {right - 200, (low + thick + high + lane) / 2};
}

/// Lanes side by side, of which one leads on.
void dead_ends(ArenaDraft& d) {
  constexpr int lanes = 4;
  const double pitch = arena_size.y / lanes;
  const auto open = static_cast<int>(d.rng.below(lanes));
  for (int i = 1; i < lanes; ++i) d.wall({600, pitch * i - 25}, {1500, pitch * i + 25});
  for (int i = 0; i < lanes; ++i)
    if (i != open) d.wall({1440, pitch * i}, {1500, pitch * (i + 1)});
  d.start.position.y = pitch * (static_cast<double>(d.rng.below(lanes)) + 0.5);
}

void narrow_lane(ArenaDraft& d, double width) {
  d.lane(400, 1600, width, arena_middle);
  d.shift_start(300);
}

void corridor_96(ArenaDraft& d) { narrow_lane(d, 96); }
void corridor_108(ArenaDraft& d) { narrow_lane(d, 108); }
void corridor_120(ArenaDraft& d) { narrow_lane(d, 120); }

/// A lane along a slanted line.
void slanted_lane(ArenaDraft& d) {
  const double rise = d.uniform(200, 500);
  const double half = d.uniform(65, 90);
  const Vec2 from{450, arena_middle - rise / 2}, to{1550, arena_middle + rise / 2};
  d.walls.push_back({{450, 0}, {1550, 0}, to - Vec2{0, half}, from - Vec2{0, half}});
  d.walls.push_back(
      {from + Vec2{0, half}, to + Vec2{0, half}, {1550, arena_size.y}, {450, arena_size.y}});
}

void zigzag(ArenaDraft& d) {
  const double gap = d.uniform(130, 220);
  for (int i = 0; i < 5; ++i) {
    const double x = 400 + 290 * i;
    if (i % 2 == 0)
      d.wall({x, 0}, {x + 40, arena_size.y - gap});
    else
      d.wall({x, gap}, {x + 40, arena_size.y});
  }
}

void doors_in_rows(ArenaDraft& d) {
  for (int i = 0; i < 4; ++i) {
    const double x = 450 + 330 * i, width = d.uniform(105, 150);
    const double centre = d.uniform(width, arena_size.y - width);
    d.lane(x, x + 40, width, centre);
  }
}

void forest_of_discs(ArenaDraft& d) {
  std::vector<std::pair<Vec2, double>> placed;
  for (int tries = 0; tries < 4000 && placed.size() < 40; ++tries) {
    const double radius = d.uniform(20, 60);
    const Vec2 at{d.uniform(320, 1680), d.uniform(60, 1140)};
    const bool is_apart = std::ranges::all_of(placed, [&](const auto& other) {
      return distance(at, other.first) > radius + other.second + 2 * arena_radius + 30;
    });
    if (!is_apart) continue;
    placed.emplace_back(at, radius);
    d.still_disc(at, radius);
  }
}

void forest_of_walls(ArenaDraft& d) {
  for (int i = 0; i < 5; ++i)
    for (int j = 0; j < 4; ++j) {
      const Vec2 at{380.0 + 280 * i + d.uniform(-30, 30), 150.0 + 300 * j + d.uniform(-30, 30)};
      const double half = d.uniform(25, 55);
      d.wall(at - Vec2{half, half}, at + Vec2{half, half});
    }
}

/// A row of discs that rest with one gap for the swarm.
void gap_among_discs(ArenaDraft& d) {
  const double gap = d.uniform(112, 135), centre = d.uniform(200, 1000);
  for (const double side : {-1.0, 1.0})
    for (double y = centre + side * (gap / 2 + 50); y > -50 && y < arena_size.y + 50;
         y += side * 90)
      d.still_disc({1000, y}, 50);
}

/// A bar that rests before a lane, beside which a second one is open.
void blocked_lane(ArenaDraft& d) {
  d.wall({900, 0}, {1100, 250});
  d.wall({900, 430}, {1100, 510});
  d.wall({900, 690}, {1100, arena_size.y});
  d.add(BoxShape{60, 170}, Still{{1000, arena_middle}});
  d.shift_start(100);
}

/// A maze of cells, drawn by a random walk that backs out of dead ends.
void cell_maze(ArenaDraft& d) {
  constexpr std::size_t columns = 8, rows = 5;
  constexpr double wall = 20, left = 180, width = 204, height = arena_size.y / rows;
  std::array<bool, columns * rows> seen{}, opens_right{}, opens_up{};
  std::vector<std::size_t> way{0};
  seen[0] = true;
  while (!way.empty()) {
    const std::size_t at = way.back(), x = at % columns, y = at / columns;
    std::vector<std::size_t> next;
    if (x > 0) next.push_back(at - 1);
    if (x + 1 < columns) next.push_back(at + 1);
    if (y > 0) next.push_back(at - columns);
    if (y + 1 < rows) next.push_back(at + columns);
    std::erase_if(next, [&](std::size_t cell) { return seen[cell]; });
    if (next.empty()) {
      way.pop_back();
      continue;
    }
    const std::size_t to = next[d.rng.below(next.size())];
    const bool is_beside = to + 1 == at || at + 1 == to;
    (is_beside ? opens_right : opens_up)[std::min(at, to)] = true;
    seen[to] = true;
    way.push_back(to);
  }
  const auto corner = [&](std::size_t x, std::size_t y) {
    return Vec2{left + width * static_cast<double>(x), height * static_cast<double>(y)};
  };
  const Vec2 aside{wall / 2, 0}, up{0, wall / 2};
  for (std::size_t y = 0; y < rows; ++y)
    for (std::size_t x = 0; x < columns; ++x) {
      const std::size_t at = y * columns + x;
      if (x == 0) d.wall(corner(0, y) - aside, corner(0, y + 1) + aside);
      if (!opens_right[at]) d.wall(corner(x + 1, y) - aside, corner(x + 1, y + 1) + aside);
      if (y + 1 < rows && !opens_up[at]) d.wall(corner(x, y + 1) - up, corner(x + 1, y + 1) + up);
    }
  const Vec2 middle{width / 2, height / 2};
  d.start = {corner(0, 0) + middle, 0};
  d.goal = corner(columns - 1, rows - 1) + middle;
}

constexpr ArenaDrawing still_kinds[] = {
    {{"open", still, "An empty room."}, empty_room},
    {{"start_at_wall", still, "The start is pressed to a wall."}, start_at_wall},
    {{"goal_at_wall", still, "The goal is pressed to a wall."}, goal_at_wall},
    {{"goal_in_pocket", still, "The goal is in a narrow pocket, its back to the start."},
     goal_in_pocket},
    {{"u_trap", still, "A pocket open to the swarm."}, u_trap},
    {{"two_traps", still, "Two pockets, one behind the other."}, two_traps},
    {{"spiral", still, "A spiral of lanes two swarms wide."}, spiral},
    {{"dead_ends", still, "Four lanes of which one leads on."}, dead_ends},
    {{"corridor_96", still, "A lane 16 µm wider than the swarm.", 45}, corridor_96},
    {{"corridor_108", still, "A lane 28 µm wider than the swarm.", 50}, corridor_108},
    {{"corridor_120", still, "A lane 40 µm wider than the swarm."}, corridor_120},
    {{"slanted_lane", still, "A slanted lane."}, slanted_lane},
    {{"zigzag", still, "Walls from both sides in turn."}, zigzag},
    {{"doors_in_rows", still, "Four walls with a door each."}, doors_in_rows},
    {{"forest_of_discs", still, "Discs that rest."}, forest_of_discs},
    {{"forest_of_walls", still, "Square posts."}, forest_of_walls},
    {{"gap_among_discs", still, "A row of resting discs with one gap."}, gap_among_discs},
    {{"blocked_lane", still, "Of two lanes the nearer is blocked by a body that rests."},
     blocked_lane},
    {{"cell_maze", still, "A maze of cells."}, cell_maze},
};

}  // namespace

std::span<const ArenaDrawing> still_drawings() { return still_kinds; }

}  // namespace microswarm::scenes
