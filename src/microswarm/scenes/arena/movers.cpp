// SPDX-License-Identifier: Apache-2.0
// Single movers and rows of them in the open, some of them faster than the swarm.
#include <numbers>
#include <vector>

#include "microswarm/core/maths/angles.hpp"
#include "microswarm/core/maths/maths.hpp"
#include "microswarm/scenes/arena/draft.hpp"

namespace microswarm::scenes {
namespace {

constexpr ArenaGroup movers = ArenaGroup::movers, fast = ArenaGroup::fast;

/// A disc that crosses the straight way about when the swarm is there.
void cross_at(ArenaDraft& d, double speed) {
  const double meets = (1000 - d.start.position.x) / arena_speed + d.uniform(-2, 2);
  d.disc({1000, arena_middle - speed * meets}, 90, {0, speed});
}
void crossing(ArenaDraft& d) { cross_at(d, d.uniform(30, 60)); }
void crossing_fast(ArenaDraft& d) { cross_at(d, d.uniform(120, 200)); }

void come(ArenaDraft& d, double speed) {
  d.disc({1000 + speed * 10.6, arena_middle + d.uniform(-15, 15)}, 80, {-speed, 0});
}
void oncoming(ArenaDraft& d) { come(d, d.uniform(30, 60)); }
void oncoming_fast(ArenaDraft& d) { come(d, d.uniform(110, 180)); }

void train(ArenaDraft& d, double x, double speed, double pitch) {
  const double first = d.uniform(0, pitch);
  for (int i = 0; i < 60; ++i)
    d.disc({x, speed > 0 ? arena_size.y + first - pitch * i : pitch * i - first}, 50, {0, speed});
}
void crossing_train(ArenaDraft& d) { train(d, 1000, d.uniform(45, 60), 260); }
void crossing_train_fast(ArenaDraft& d) { train(d, 1000, d.uniform(110, 150), 420); }
void two_lanes(ArenaDraft& d) {
  const double speed = d.uniform(40, 55);
  train(d, 850, speed, 300);
  train(d, 1150, -speed, 300);
}

void oncoming_row(ArenaDraft& d) {
  const double offset = d.uniform(0, 240), speed = d.uniform(30, 50);
  for (int i = 0; i < 7; ++i) d.disc({1600, -240 + offset + 240 * i}, 60, {-speed, 0});
}

void overtake(ArenaDraft& d) {
  d.disc({450, arena_middle + d.uniform(-20, 20)}, 100, {d.uniform(20, 40), 0});
}

void chased(ArenaDraft& d) {
  d.start.position.x = 500;
  d.disc({-500 + d.uniform(-100, 100), arena_middle + d.uniform(-20, 20)}, 80, {120, 0});
}

void against_flow(ArenaDraft& d) {
  for (int i = 0; i < 30; ++i)
    d.disc({600 + d.uniform(0, 3300), d.uniform(100, 1100)}, d.uniform(25, 45),
           {-d.uniform(30, 60), 0});
}

/// A bar nearly as long as the room is high, which must be passed at its end.
void sweeping_bar(ArenaDraft& d) {
  const double y = d.rng.below(2) == 0 ? 725.0 : 475.0;
  d.add(BoxShape{60, 950}, Straight{{d.uniform(1300, 1600), y}, {-d.uniform(20, 40), 0}});
}

/// A bar comes down on the border that the swarm runs along.
void pressed_to_wall(ArenaDraft& d) {
  d.start = {{300, 60}, 0};
  d.goal = {1850, 60};
  d.add(BoxShape{700, 60}, Straight{{d.uniform(800, 1000), 620}, {0, -d.uniform(20, 30)}});
  d.still_disc({1500, 300}, 60);
}

/// Discs that circle around the goal.
void roundabout(ArenaDraft& d) {
  d.goal = {1400, arena_middle};
  constexpr int discs = 5, corners = 24;
  const double turn = d.uniform(0, 2 * pi), speed = d.uniform(25, 45);
  for (int i = 0; i < discs; ++i) {
    std::vector<Vec2> circle;
    for (int k = 0; k < corners; ++k) {
      const double angle =
          turn + 2 * pi * (static_cast<double>(k) / corners + static_cast<double>(i) / discs);
      circle.push_back(d.goal + 300 * Vec2{maths::cos(angle), maths::sin(angle)});
    }
    d.add(DiscShape{55}, Waypoints{circle, speed, AtEnd::loop});
  }
}

/// A disc leaves the goal late.
void goal_occupied(ArenaDraft& d) {
  d.add(DiscShape{80},
        Waypoints{{{1850, 600}, {1850, 720}, {1850, 1100}}, d.uniform(8, 16), AtEnd::stay});
}

constexpr ArenaDrawing mover_kinds[] = {
    {{"crossing", movers, "A disc crosses the way."}, crossing},
    {{"oncoming", movers, "A disc comes."}, oncoming},
    {{"oncoming_row", movers, "A row of discs comes."}, oncoming_row},
    {{"crossing_train", movers, "A train of discs crosses."}, crossing_train},
    {{"two_lanes", movers, "Two trains cross in opposite directions."}, two_lanes},
    {{"overtake", movers, "A slower disc ahead."}, overtake},
    {{"against_flow", movers, "Thirty discs come."}, against_flow},
    {{"sweeping_bar", movers, "A long bar comes."}, sweeping_bar},
    {{"pressed_to_wall", movers, "A bar comes down on the border."}, pressed_to_wall},
    {{"roundabout", movers, "Discs circle around the goal."}, roundabout},
    {{"goal_occupied", movers, "A disc is on the goal at first."}, goal_occupied},
    {{"crossing_fast", fast, "A disc crosses at twice the swarm's speed."}, crossing_fast},
    {{"oncoming_fast", fast, "A disc comes at up to twice the swarm's speed."}, oncoming_fast},
    {{"crossing_train_fast", fast, "A train that is faster than the swarm."}, crossing_train_fast},
    {{"chased", fast, "A faster disc from behind."}, chased},
};

}  // namespace

std::span<const ArenaDrawing> mover_drawings() { return mover_kinds; }

}  // namespace microswarm::scenes
