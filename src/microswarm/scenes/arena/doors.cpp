// SPDX-License-Identifier: Apache-2.0
// Doors, valves and gaps that open and close.
#include <algorithm>

#include "microswarm/core/maths/angles.hpp"
#include "microswarm/scenes/arena/draft.hpp"

namespace microswarm::scenes {
namespace {

constexpr ArenaGroup doors = ArenaGroup::doors;

void valve_at(ArenaDraft& d, double x, double period) {
  d.lane(x - 20, x + 20, 300);
  d.add(Valve{300, 30, 0, 280, period, d.uniform(0, 1)}, Still{{x, arena_middle}});
}

void valve(ArenaDraft& d) { valve_at(d, 1000, d.uniform(16, 26)); }
void fast_valve(ArenaDraft& d) { valve_at(d, 1000, d.uniform(5, 8)); }
void two_valves(ArenaDraft& d) {
  const double period = d.uniform(14, 24);
  valve_at(d, 750, period);
  valve_at(d, 1250, period);
}

/// A door that slides up once.
void opening_door(ArenaDraft& d) {
  d.lane(980, 1020, 200);
  d.add(BoxShape{30, 199},
        Waypoints{{{1000, 600}, {1000, 601}, {1000, 850}}, d.uniform(6, 12), AtEnd::stay});
}

/// A door that shuts before the swarm is there, below or above a gap that stays open.
void closing_door(ArenaDraft& d) {
  const bool is_above = d.rng.below(2) == 0;
  const auto height = [&](double y) { return is_above ? y : arena_size.y - y; };
  const auto wall = [&](double low, double high) {
    const double a = height(low), b = height(high);
    d.wall({980, std::min(a, b)}, {1020, std::max(a, b)});
  };
  wall(0, 500);
  wall(700, 900);
  wall(1140, arena_size.y);
  d.add(BoxShape{30, 199},
        Waypoints{{{1000, height(360)}, {1000, arena_middle}}, d.uniform(30, 45), AtEnd::stay});
}

void sliding_gap(ArenaDraft& d) {
  const double period = d.uniform(30, 50), phase = d.uniform(0, 1);
  for (const double y : {70.0, 1130.0})
    d.add(BoxShape{50, 900}, HarmonicLine{{1000, y}, {0, 350}, period, phase});
}

void two_sliding_gaps(ArenaDraft& d) {
  for (const double x : {800.0, 1250.0}) {
    const double period = d.uniform(30, 50), phase = d.uniform(0, 1);
    for (const double y : {70.0, 1130.0})
      d.add(BoxShape{50, 900}, HarmonicLine{{x, y}, {0, 350}, period, phase});
  }
}

/// A leaf on a hinge that swings through a doorway.
void swinging_door(ArenaDraft& d) {
  d.lane(980, 1020, 320);
  d.add(DiscShape{60},
        HarmonicArc{{1000, 440}, 160, pi / 2, 1.2, d.uniform(16, 26), d.uniform(0, 1)});
}

constexpr ArenaDrawing door_kinds[] = {
    {{"valve", doors, "A valve."}, valve},
    {{"fast_valve", doors, "A valve that is open for a few seconds."}, fast_valve},
    {{"two_valves", doors, "Two valves that are not in phase."}, two_valves},
    {{"opening_door", doors, "A door that opens late."}, opening_door},
    {{"closing_door", doors, "A door that shuts beside an open gap."}, closing_door},
    {{"sliding_gap", doors, "A gap that moves up and down."}, sliding_gap},
    {{"two_sliding_gaps", doors, "Two gaps that move up and down."}, two_sliding_gaps},
    {{"swinging_door", doors, "A disc that swings through a doorway."}, swinging_door},
};

}  // namespace

std::span<const ArenaDrawing> door_drawings() { return door_kinds; }

}  // namespace microswarm::scenes
