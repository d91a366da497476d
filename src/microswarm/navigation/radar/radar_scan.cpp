// SPDX-License-Identifier: Apache-2.0
#include "microswarm/navigation/radar/radar_scan.hpp"

#include <algorithm>
#include <cmath>

#include "microswarm/core/maths/angles.hpp"
#include "microswarm/geometry/distance.hpp"
#include "microswarm/navigation/prediction/obstacle_tracker.hpp"

namespace microswarm::navigation {
namespace {

double nearness(Vec2 position, Vec2 target) {
  return 1 / std::max(distance(position, target), min_distance);
}

Vec2 position_ahead(const RadarLook& look, double heading) {
  return look.centre + look.step * unit_vector(heading);
}

/// Eq 17, 30
void screen(RadarBeam& beam, const RadarLook& look, const Snapshot& world) {
  const Vec2 position = position_ahead(look, beam.heading);
  for (const Body& body : world.moving().bodies()) {
    if (distance(position, body) >= look.obstacle_reach()) continue;
    beam.fate = BeamFate::obstacle;
    beam.obstacle = body.obstacle;
    return;
  }
  if (!world.map().is_free(position, look.wall_reach())) beam.fate = BeamFate::wall;
}

std::optional<std::uint32_t> nearest_body(const RadarLook& look, const Snapshot& world) {
  std::optional<std::uint32_t> nearest;
  double least = look.circles.detection + look.approach;
  const auto bodies = world.moving().bodies();
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const double d = distance(look.centre, bodies[i]);
    if (d >= least) continue;
    least = d;
    nearest = static_cast<std::uint32_t>(i);
  }
  return nearest;
}

/// From χ_2 only directions that keep the course are taken, if there are any; φ_i is computed over
/// all of χ_2.
void keep_course(RadarDiagnostics& out, const RadarLook& look) {
  const auto is_on = [&](const RadarBeam& beam) {
    return beam.fate == BeamFate::kept && keeps_course(look, unit_vector(beam.heading));
  };
  if (std::none_of(out.beams.begin(), out.beams.end(), is_on)) return;
  for (RadarBeam& beam : out.beams)
    if (beam.fate == BeamFate::kept && !is_on(beam)) beam.fate = BeamFate::turn;
}

/// Eq 9
void rate(RadarDiagnostics& out, const RadarLook& look, const Snapshot& world) {
  // N(·) removes constants: r_s, r_ob.
  const auto gap = [&](Vec2 p) {
    if (!out.nearest) return 0.0;
    const Body& body = world.moving().bodies()[*out.nearest];
    const auto centre = rotation_centre(body);
    return centre ? distance(*centre, p) : distance(p, body);
  };
  MinMax towards, away;
  for (const RadarBeam& beam : out.beams) {
    if (beam.fate != BeamFate::kept) continue;
    const Vec2 position = position_ahead(look, beam.heading);
    towards.include(nearness(position, look.target));
    away.include(gap(position));
  }
  for (RadarBeam& beam : out.beams) {
    if (beam.fate != BeamFate::kept) continue;
    const Vec2 position = position_ahead(look, beam.heading);
    beam.score = out.weights.target * towards.normalised(nearness(position, look.target)) +
                 out.weights.avoidance * away.normalised(gap(position));
  }
}

/// (1/s − 1/r_d) / (1/r_0 − 1/r_d), finite where r_0 is r_d.
double relative_proximity(double s, double r_0, double r_d) {
  constexpr double least = 1e-6;  // [µm]
  const double scale = r_d - r_0;
  const double apart = std::max(s, least);
  return (r_d - apart) / apart * r_0 / std::copysign(std::max(std::abs(scale), least), scale);
}

/// Eq 13
void choose(RadarDiagnostics& out) {
  for (std::uint32_t i = 0; i < out.beams.size(); ++i) {
    const RadarBeam& beam = out.beams[i];
    if (beam.fate != BeamFate::kept) continue;
    if (!out.best || beam.score > out.beams[*out.best].score) out.best = i;
  }
}

}  // namespace

std::optional<Vec2> rotation_centre(const Body& body) {
  const Vec2 centre = enclosing_disc(body).centre;
  return distance(centre, body) > 0 ? std::nullopt : std::optional(centre);
}

double obstacle_radius(const RadarLook& look, const Body& body) {
  if (!look.printed_weights) return 0;
  return distance(look.centre, enclosing_disc(body).centre) - distance(look.centre, body);
}

RadarWeights radar_weights(const RadarLook& look, double distance_to_edge, double obstacle_radius) {
  const double r_s = look.radius;
  const double r_d = look.circles.detection;
  const double relative = distance(look.centre, look.target) / r_d;
  if (look.printed_weights) {  // Eq 10–12
    const double target = 1 + look.target_gain * relative * relative;
    const double near =
        relative_proximity(distance_to_edge + obstacle_radius, r_s + obstacle_radius, r_d);
    return {.target = target,
            .avoidance = std::min(target, 0.5 + look.avoidance_gain / 2 * near * near)};
  }
  const double s = std::clamp(distance_to_edge, r_s, r_d);
  const double near = (1 / s - 1 / r_d) / (1 / r_s - 1 / r_d);
  return {.target = 1 + look.target_gain * relative * relative,
          .avoidance = 0.5 + look.avoidance_gain / 2 * near * near};
}

RadarDiagnostics scan(const RadarLook& look, const Snapshot& world, int directions) {
  RadarDiagnostics out{.centre = look.centre,
                       .radius = look.radius,
                       .target = look.target,
                       .circles = look.circles,
                       .step = look.step,
                       .obstacle_reach = look.obstacle_reach(),
                       .wall_reach = look.wall_reach(),
                       .weights = {}};
  out.nearest = nearest_body(look, world);
  for (int i = 0; i < directions; ++i) {
    out.beams.push_back({.heading = wrap(2 * pi * i / directions)});
    screen(out.beams.back(), look, world);
  }
  if (out.nearest) {
    const Body& body = world.moving().bodies()[*out.nearest];
    out.weights = radar_weights(look, distance(look.centre, body) - look.approach,
                                obstacle_radius(look, body));
  } else {
    out.weights = {radar_weights(look, look.circles.detection).target, 0};
    // Eq 14–16; no farther than the target, which may be in front of a wall.
    const double heading = heading_along(look.target - look.centre);
    const double ahead = std::min(look.step, distance(look.centre, look.target));
    if (world.map().is_free(look.centre + ahead * unit_vector(heading), look.wall_reach()))
      out.straight = heading;
  }
  rate(out, look, world);
  keep_course(out, look);
  choose(out);
  return out;
}

}  // namespace microswarm::navigation
