// SPDX-License-Identifier: Apache-2.0
// Crowds, crowds that are seen badly, deforming channels, and bodies that appear.
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "microswarm/geometry/vec2.hpp"
#include "microswarm/scenes/arena/draft.hpp"

namespace microswarm::scenes {
namespace {

constexpr ArenaGroup crowds = ArenaGroup::crowds, sight = ArenaGroup::sight,
                     surprises = ArenaGroup::surprises;

/// Discs that walk between four places each.
void crowd(ArenaDraft& d, int discs, double slowest, double fastest) {
  for (int i = 0; i < discs; ++i) {
    std::vector<Vec2> places;
    places.reserve(4);
    for (int k = 0; k < 4; ++k) places.push_back({d.uniform(350, 1680), d.uniform(50, 1150)});
    const double radius = d.uniform(22, 50);
    d.add(DiscShape{radius}, Waypoints{places, d.uniform(slowest, fastest), AtEnd::loop});
  }
}
void seen_crowd(ArenaDraft& d) { crowd(d, 20, 20, 55); }

void crowd_10(ArenaDraft& d) { crowd(d, 10, 20, 50); }
void crowd_30(ArenaDraft& d) { crowd(d, 30, 20, 50); }
void crowd_60(ArenaDraft& d) { crowd(d, 60, 20, 45); }
void crowd_fast(ArenaDraft& d) { crowd(d, 12, 80, 140); }

void breathing_field(ArenaDraft& d) {
  for (int i = 0; i < 5; ++i)
    for (int j = 0; j < 5; ++j)
      d.add(BreathingDisc{30, 105, d.uniform(10, 20), d.uniform(0, 1)},
            Still{{450 + 270.0 * i + (j % 2 == 0 ? 0 : 100), 120 + 240.0 * j}});
}

void noisy(ArenaDraft& d, double noise) {
  seen_crowd(d);
  d.sensing.position_noise = d.sensing.obstacle_noise = noise;
}
void noisy_3(ArenaDraft& d) { noisy(d, 3); }
void noisy_8(ArenaDraft& d) { noisy(d, 8); }

void dropout(ArenaDraft& d, double share) {
  seen_crowd(d);
  d.sensing.missed_share = d.sensing.obstacle_missed_share = share;
}
void dropout_10(ArenaDraft& d) { dropout(d, 0.1); }
void dropout_30(ArenaDraft& d) { dropout(d, 0.3); }

void late(ArenaDraft& d, double delay) {
  seen_crowd(d);
  d.sensing.observation_delay = delay;
}
void delay_200(ArenaDraft& d) { late(d, 0.2); }
void delay_400(ArenaDraft& d) { late(d, 0.4); }

VortexParams& vortex(ArenaDraft& d) { return std::get<VortexParams>(d.swarm); }

void slow_response(ArenaDraft& d) {
  late(d, 0.3);
  vortex(d).response_lag = 0.3;
}

void noisy_motion(ArenaDraft& d) {
  seen_crowd(d);
  vortex(d).position_noise = 8;
  d.sensing.position_noise = 2;
}

void all_bad(ArenaDraft& d) {
  seen_crowd(d);
  vortex(d).position_noise = 4;
  vortex(d).radius_ripple = 2;
  d.sensing.observation_delay = 0.2;
  d.sensing.position_noise = d.sensing.obstacle_noise = 4;
  d.sensing.missed_share = d.sensing.obstacle_missed_share = 0.15;
}

void channel(ArenaDraft& d, double half_width) {
  DeformingChannel c;
  const double bend = d.uniform(60, 110);
  c.centre_line = {{150, 600}, {500, 600 + bend}, {1000, 600}, {1500, 600 - bend}, {1850, 600}};
  c.half_width = half_width;
  c.end_half_width = half_width + 40;
  c.end_length = 150;
  c.amplitude = 30;
  c.wavelength = 600;
  c.period = d.uniform(10, 20);
  c.block_centre = {1000, 600};
  c.block_width = 2400;
  c.block_height = 1400;
  d.add(c, Still{});
}
void channel_wide(ArenaDraft& d) { channel(d, 150); }
void channel_narrow(ArenaDraft& d) { channel(d, 105); }
void channel_mover(ArenaDraft& d) {
  channel(d, 190);
  d.disc({d.uniform(1400, 1650), 560}, 40, {-d.uniform(15, 30), d.uniform(0, 5)});
}

/// A disc that is there from a time on, at rest.
void appear(ArenaDraft& d, Vec2 at, double time) {
  Track track{"appears.csv", std::to_string(d.obstacles.size() + 1), {}};
  track.samples = std::make_shared<const Samples>(Samples{{time, 1000}, {at, at}});
  d.add(DiscShape{80}, track);
}
void appears(ArenaDraft& d) {
  appear(d, {d.uniform(900, 1300), arena_middle + d.uniform(-40, 40)}, d.uniform(2, 6));
}
void appears_in_gap(ArenaDraft& d) {
  d.wall({980, 0}, {1020, 250});
  d.wall({980, 450}, {1020, 500});
  d.wall({980, 700}, {1020, arena_size.y});
  appear(d, {1000, arena_middle}, d.uniform(4, 7));
}

constexpr ArenaDrawing crowd_kinds[] = {
    {{"crowd_10", crowds, "Ten discs that walk about."}, crowd_10},
    {{"crowd_30", crowds, "Thirty discs that walk about."}, crowd_30},
    {{"crowd_60", crowds, "Sixty discs that walk about."}, crowd_60},
    {{"crowd_fast", ArenaGroup::fast, "Twelve discs, faster than the swarm."}, crowd_fast},
    {{"breathing_field", crowds, "A field of discs that grow and shrink."}, breathing_field},
    {{"noisy_3", sight, "Positions with 3 µm of noise."}, noisy_3},
    {{"noisy_8", sight, "Positions with 8 µm of noise."}, noisy_8},
    {{"dropout_10", sight, "A tenth of what is there is not seen."}, dropout_10},
    {{"dropout_30", sight, "A third of what is there is not seen."}, dropout_30},
    {{"delay_200", sight, "Frames that are 0.2 s old."}, delay_200},
    {{"delay_400", sight, "Frames that are 0.4 s old."}, delay_400},
    {{"slow_response", sight, "Frames that are 0.3 s old, and a swarm that answers late."},
     slow_response},
    {{"noisy_motion", sight, "A swarm that strays."}, noisy_motion},
    {{"all_bad", sight, "Noise, misses and delay at once."}, all_bad},
    {{"channel_wide", surprises, "A channel whose walls move."}, channel_wide},
    {{"channel_narrow", surprises, "A narrow channel whose walls move."}, channel_narrow},
    {{"channel_mover", surprises, "A disc in a channel whose walls move."}, channel_mover},
    {{"appears", surprises, "A disc that is suddenly there."}, appears},
    {{"appears_in_gap", surprises, "A disc is suddenly in the gap, beside another gap."},
     appears_in_gap},
};

}  // namespace

std::span<const ArenaDrawing> crowd_drawings() { return crowd_kinds; }

}  // namespace microswarm::scenes
