// SPDX-License-Identifier: Apache-2.0
// Traffic in a lane that is two to four swarms wide.
#include "microswarm/scenes/arena/draft.hpp"

namespace microswarm::scenes {
namespace {

constexpr ArenaGroup corridors = ArenaGroup::corridors;
constexpr double wide = 300;  // [µm]

double beside(ArenaDraft& d, double offset) {
  return arena_middle + (d.rng.below(2) == 0 ? offset : -offset);
}

void wide_lane(ArenaDraft& d) { d.lane(400, 1600, wide); }

/// A disc ahead that is slower and leaves no room beside it.
void lane_follow(ArenaDraft& d) {
  wide_lane(d);
  d.disc({d.uniform(420, 520), arena_middle}, 105, {d.uniform(30, 45), 0});
}

void lane_overtake(ArenaDraft& d) {
  wide_lane(d);
  d.disc({420, beside(d, 70)}, 60, {d.uniform(15, 30), 0});
}

void lane_oncoming(ArenaDraft& d) {
  wide_lane(d);
  d.disc({d.uniform(1500, 1800), beside(d, 80)}, 55, {-d.uniform(25, 50), 0});
}

void lane_convoy(ArenaDraft& d) {
  wide_lane(d);
  const double speed = d.uniform(20, 30);
  for (int i = 0; i < 4; ++i)
    d.disc({420 + 260.0 * i, arena_middle + (i % 2 == 0 ? -70 : 70)}, 55, {speed, 0});
}

/// A disc as wide as the lane comes; the only refuge is a pocket beside it.
void lane_head_on_pocket(ArenaDraft& d) {
  d.wall({500, 0}, {1500, 535});
  d.wall({500, 665}, {900, arena_size.y});
  d.wall({1100, 665}, {1500, arena_size.y});
  d.disc({d.uniform(1700, 1900), arena_middle}, 50, {-d.uniform(35, 50), 0});
}

void lane_oscillator(ArenaDraft& d) {
  wide_lane(d);
  d.add(BoxShape{120, 180},
        HarmonicLine{{1000, 540}, {350, 0}, d.uniform(45, 70), d.uniform(0, 1)});
}

void lane_piston(ArenaDraft& d) {
  wide_lane(d);
  d.add(BoxShape{100, 300},
        HarmonicLine{{1000, 760}, {0, 160}, d.uniform(12, 24), d.uniform(0, 1)});
}

void lane_two_pistons(ArenaDraft& d) {
  wide_lane(d);
  const double period = d.uniform(14, 24);
  d.add(BoxShape{100, 300}, HarmonicLine{{800, 760}, {0, 160}, period, d.uniform(0, 1)});
  d.add(BoxShape{100, 300}, HarmonicLine{{1200, 440}, {0, 160}, period, d.uniform(0, 1)});
}

void lane_breathing_plug(ArenaDraft& d) {
  wide_lane(d);
  d.add(BreathingDisc{30, 130, d.uniform(14, 26), d.uniform(0, 1)}, Still{{1000, arena_middle}});
}

/// Two lanes that cross; discs come along the other one.
void blind_corner(ArenaDraft& d) {
  for (const double x : {0.0, 1100.0})
    for (const double y : {0.0, 700.0}) d.wall({x, y}, {x + 900, y + 500});
  const double first = d.uniform(700, 1300), speed = d.uniform(40, 55);
  for (int i = 0; i < 40; ++i) d.disc({1000, first - 420.0 * i}, 70, {0, speed});
}

constexpr ArenaDrawing corridor_kinds[] = {
    {{"lane_follow", corridors, "Behind a slower disc that cannot be passed."}, lane_follow},
    {{"lane_overtake", corridors, "Past a slower disc."}, lane_overtake},
    {{"lane_oncoming", corridors, "Past a disc that comes."}, lane_oncoming},
    {{"lane_convoy", corridors, "Four slower discs, left and right in turn."}, lane_convoy},
    {{"lane_pocket", corridors, "A disc comes that can only be let by in a pocket.", 48},
     lane_head_on_pocket},
    {{"lane_oscillator", corridors, "A box that goes to and fro in the lane."}, lane_oscillator},
    {{"lane_piston", corridors, "A piston that shuts the lane at times."}, lane_piston},
    {{"lane_two_pistons", corridors, "Two pistons from both sides."}, lane_two_pistons},
    {{"lane_breathing_plug", corridors, "A disc that fills the lane at times."},
     lane_breathing_plug},
    {{"blind_corner", corridors, "Discs come along a lane that is crossed."}, blind_corner},
};

}  // namespace

std::span<const ArenaDrawing> corridor_drawings() { return corridor_kinds; }

}  // namespace microswarm::scenes
