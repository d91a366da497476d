// SPDX-License-Identifier: Apache-2.0
#include "microswarm/scenes/pedestrians.hpp"

#include <algorithm>

#include "microswarm/core/maths/angles.hpp"
#include "microswarm/core/maths/rng.hpp"
#include "microswarm/geometry/uniform_in.hpp"
#include "microswarm/scenes/avoidance_worlds.hpp"

namespace microswarm::scenes {
namespace {

constexpr double um_per_m = 150;
constexpr double walker_radius = 45;
constexpr double min_distance = 900;  // minimum distance from start to goal [µm]
constexpr Box street{{-1300, 550}, {1150, 3300}};
constexpr Box inner{{-1000, 850}, {850, 3000}};

Samples begun_at(const Samples& samples, double t) {
  Samples out = samples;
  for (double& time : out.times) time -= t;
  return out;
}

bool starts_apart(const experiment::Scenario& s) {
  const double radius = swarm_limits(s.swarm).radius;
  return std::all_of(s.obstacles.begin(), s.obstacles.end(), [&](const Obstacle& walker) {
    const Placement at = placement(walker.motion, 0);
    return !at.present || distance(at.pose.position, s.start->position) >=
                              radius + walker_radius + avoidance_start_gap + norm(at.velocity);
  });
}

void place_ends(experiment::Scenario& s, Rng& rng) {
  constexpr int max_tries = 1000;
  for (int i = 0; i < max_tries; ++i) {
    s.start = Pose2{uniform_in(inner, rng), 0};
    s.goal = uniform_in(inner, rng);
    s.start->heading = heading_along(*s.goal - s.start->position);
    if (distance(s.start->position, *s.goal) > min_distance && starts_apart(s)) return;
  }
}

}  // namespace

std::filesystem::path street_file(const std::filesystem::path& data) {
  return data / "moving_obstacles" / "ucy_zara01_obsmat.txt";
}

Street read_street(const std::filesystem::path& file, double slower) {
  Street out{formats::read_ucy_obsmat(file, um_per_m, slower)};
  for (const auto& [id, samples] : out.tracks)
    out.recording = std::max(out.recording, samples.times.back());
  return out;
}

experiment::Scenario street_scenario(const Street& recorded, std::uint64_t seed) {
  Rng rng(seed, Purpose::start_goal);
  experiment::Scenario s;
  s.map = formats::PolygonsMap{.lo = street.lo, .hi = street.hi, .walls = {}, .discs = {}};
  s.swarm = VortexParams{.radius = 40,
                         .moving_radius = 40,
                         .radius_ripple = 0.5,
                         .max_speed = 60,
                         .position_noise = 1};
  s.sensing = {.position_noise = 1, .heading_noise = 0.02, .missed_share = 0.02};
  s.seed = seed;
  s.goal_tolerance = 30;
  s.time_limit = 240;
  s.hold_limit = s.time_limit;
  s.stop_at_contact = false;
  s.detection_range = avoidance_detection_range;
  const double begin = rng.uniform(0, std::max(0.0, recorded.recording - s.time_limit));
  for (const auto& [id, samples] : recorded.tracks) {
    if (samples.times.back() < begin || samples.times.front() > begin + s.time_limit) continue;
    Track track;
    track.id = id;
    track.samples = std::make_shared<const Samples>(begun_at(samples, begin));
    s.obstacles.push_back({DiscShape{walker_radius}, std::move(track)});
  }
  place_ends(s, rng);
  return s;
}

}  // namespace microswarm::scenes
