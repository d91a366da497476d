// SPDX-License-Identifier: Apache-2.0
#include "microswarm/navigation/radar/radar_scanner.hpp"

#include <algorithm>
#include <cmath>

#include "microswarm/core/maths/angles.hpp"
#include "microswarm/core/maths/infinity.hpp"
#include "microswarm/geometry/distance.hpp"

namespace microswarm::navigation {
namespace {

constexpr double scan_rounding = 1e-6;  // of distances [µm]

}  // namespace

RadarScanner::RadarScanner(int directions, const RadarTuning& tuning) : tuning_(tuning) {
  const auto n = static_cast<std::size_t>(directions);
  for (int i = 0; i < directions; ++i) {
    const Vec2 u = unit_vector(wrap(2 * pi * i / directions));
    ux_.push_back(u.x);
    uy_.push_back(u.y);
  }
  for (auto* buffer : {&px_, &py_, &room_, &gap_, &nearness_}) buffer->resize(n);
  discs_.reserve(64);
  edges_.reserve(256);
  bodies_.reserve(64);
}

double RadarScanner::heading(std::size_t i) const {
  return wrap(2 * pi * static_cast<int>(i) / directions());
}

void RadarScanner::note(RadarContact contact) {
  if (!nearest_ || contact.distance < nearest_->distance ||
      (contact.distance == nearest_->distance && contact.body < nearest_->body))
    nearest_ = contact;
}

std::optional<RadarContact> RadarScanner::detect(const RadarLook& look, const Snapshot& world) {
  nearest_.reset();
  discs_.clear();
  edges_.clear();
  bodies_.clear();
  const double reach = look.circles.detection + look.approach;
  const BodySet& moving = world.moving();
  const Box near = Box{look.centre, look.centre}.grown(reach);
  moving.discs().for_each_in(near, [&](std::size_t i) {
    const Disc disc = moving.discs().disc(i);
    const double d = distance(look.centre, disc);
    if (d >= reach) return;
    const std::uint32_t body = moving.discs().enclosing_pose(i);
    discs_.push_back({disc, d});
    bodies_.push_back(body);
    note({body, d - look.approach});
  });
  // An edge farther away is not its body's nearest one to a predictive swarm.
  const double far = reach + 2 * look.step;
  moving.polygons().for_each_edge_in(near.grown(2 * look.step), [&](std::uint32_t body, Segment e) {
    const double squared = squared_distance(look.centre, e);
    if (squared >= far * far) return;
    edges_.push_back({e, body});
    const double d = std::sqrt(squared);
    if (d >= reach) return;
    if (std::find(bodies_.begin(), bodies_.end(), body) == bodies_.end()) bodies_.push_back(body);
    note({body, d - look.approach});
  });
  return nearest_;
}

void RadarScanner::place(const RadarLook& look) {
  for (std::size_t i = 0; i < ux_.size(); ++i) {
    px_[i] = look.centre.x + look.step * ux_[i];
    py_[i] = look.centre.y + look.step * uy_[i];
  }
}

void RadarScanner::screen(const RadarLook& look, const Snapshot& world) {
  place(look);
  screen_by_obstacles(look, world);
  screen_by_walls(look, world);
}

// Eq 17, 30. Nothing outside the safety circle screens a direction, since after a step of d_p it is
// still d_f away.
void RadarScanner::screen_by_obstacles(const RadarLook& look, const Snapshot& world) {
  std::fill(room_.begin(), room_.end(), infinity);
  const double reach = look.obstacle_reach();
  for (const NearDisc& near : discs_) {
    if (near.distance > reach + look.step + scan_rounding) continue;
    const Vec2 c = near.disc.centre;
    const double keep = near.disc.radius + reach;
    for (std::size_t i = 0; i < room_.size(); ++i) {
      const double dx = c.x - px_[i];
      const double dy = c.y - py_[i];
      room_[i] = std::min(room_[i], dx * dx + dy * dy - keep * keep);
    }
  }
  for (const NearEdge& near : edges_) {
    if (distance(look.centre, near.edge) > reach + look.step + scan_rounding) continue;
    for (std::size_t i = 0; i < room_.size(); ++i)
      room_[i] =
          std::min(room_[i], squared_distance(Vec2{px_[i], py_[i]}, near.edge) - reach * reach);
  }
  if (edges_.empty() || look.step < reach) return;  // otherwise a step may end deep inside
  for (std::size_t i = 0; i < room_.size(); ++i)
    if (room_[i] >= 0 && world.moving().polygons().holds({px_[i], py_[i]})) room_[i] = -1;
}

void RadarScanner::screen_by_walls(const RadarLook& look, const Snapshot& world) {
  const double reach = look.wall_reach();
  const Map& map = world.map();
  if (map.field().lower(look.centre) >= reach + look.step + scan_rounding) return;
  for (std::size_t i = 0; i < room_.size(); ++i)
    if (room_[i] >= 0 && !map.is_free(Vec2{px_[i], py_[i]}, reach)) room_[i] = -1;
}

// 1/‖O_pe O_t‖ of Eq 9.
void RadarScanner::measure_distance(Vec2 target) {
  for (std::size_t i = 0; i < nearness_.size(); ++i) {
    const double dx = target.x - px_[i];
    const double dy = target.y - py_[i];
    const double length = std::sqrt(dx * dx + dy * dy);
    nearness_[i] = 1 / (length > min_distance ? length : min_distance);
  }
}

// ‖O_pe O_ob‖ of Eq 9; N(·) removes r_s and r_ob.
void RadarScanner::measure_gap(const Snapshot& world) {
  if (const auto centre = rotation_centre(world.moving().bodies()[nearest_->body])) {
    for (std::size_t i = 0; i < gap_.size(); ++i) {
      const double dx = centre->x - px_[i];
      const double dy = centre->y - py_[i];
      gap_[i] = std::sqrt(dx * dx + dy * dy);
    }
    return;
  }
  std::fill(gap_.begin(), gap_.end(), infinity);
  for (const NearEdge& near : edges_) {
    if (near.body != nearest_->body) continue;
    for (std::size_t i = 0; i < gap_.size(); ++i)
      gap_[i] = std::min(gap_[i], squared_distance(Vec2{px_[i], py_[i]}, near.edge));
  }
  for (double& g : gap_) g = std::sqrt(g);
}

// Eq 9–13, 31 over the directions kept in room_.
std::optional<std::size_t> RadarScanner::best(const RadarLook& look, const Snapshot& world) {
  RadarWeights weights{radar_weights(look, look.circles.detection).target, 0};
  measure_distance(look.target);
  if (nearest_) {
    weights = radar_weights(look, nearest_->distance,
                            obstacle_radius(look, world.moving().bodies()[nearest_->body]));
    measure_gap(world);
  } else {
    std::fill(gap_.begin(), gap_.end(), 0);
  }
  MinMax nearness, gap;
  for (std::size_t i = 0; i < room_.size(); ++i) {
    if (room_[i] < 0) continue;
    nearness.include(nearness_[i]);
    gap.include(gap_[i]);
  }
  // N(·) is over all of χ_2; among these, directions that keep the course are preferred.
  std::optional<std::size_t> found;
  double most = 0;
  bool on_course = false;
  for (std::size_t i = 0; i < room_.size(); ++i) {
    if (room_[i] < 0) continue;
    const bool keeps = keeps_course(look, {ux_[i], uy_[i]});
    if (on_course && !keeps) continue;
    const double score = weights.target * nearness.normalised(nearness_[i]) +
                         weights.avoidance * gap.normalised(gap_[i]);
    if (found && keeps == on_course && score <= most) continue;
    most = score;
    found = i;
    on_course = keeps;
  }
  return found;
}

std::optional<double> RadarScanner::choose(const RadarLook& look, const Snapshot& world) {
  if (!nearest_) {  // Eq 14–16
    const double straight = heading_along(look.target - look.centre);
    const double ahead = std::min(look.step, distance(look.centre, look.target));
    if (world.map().is_free(look.centre + ahead * unit_vector(straight), look.wall_reach()))
      return straight;
  }
  screen(look, world);
  const auto found = best(look, world);
  if (!found) return std::nullopt;
  // Only walls detected and no direction leads nearer to the target: moving away would only lead
  // back.
  const bool gains =
      distance({px_[*found], py_[*found]}, look.target) < distance(look.centre, look.target);
  if (!nearest_ && !gains) return std::nullopt;
  return heading(*found);
}

std::vector<bool> RadarScanner::kept(const RadarLook& look, const Snapshot& world) {
  screen(look, world);
  std::vector<bool> out(room_.size());
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = room_[i] >= 0;
  return out;
}

RadarScanner::Outcome RadarScanner::outcome(const RadarLook& look, const Snapshot& world,
                                            Vec2 to) const {
  const Segment leg{look.centre, to};
  const Map& map = world.map();
  Outcome out{.on_path = map.clearance(leg, look.circles.detection), .at_end = map.clearance(to)};
  for (const std::uint32_t i : bodies_) {
    const Body& body = world.moving().bodies()[i];
    out.on_path = std::min(out.on_path, distance(leg, body));
    out.at_end = std::min(out.at_end, distance(to, body));
  }
  out.at_end = std::min(out.at_end, look.circles.detection);
  return out;
}

// Maximises the minimum distance along the path plus that at its end, over one step or a longer
// path.
std::optional<double> RadarScanner::retreat(const RadarLook& look, const Snapshot& world) const {
  const double hold =
      outcome(look, world, look.centre).worth() + tuning_.min_retreat_gain * look.step;
  std::optional<std::size_t> found;
  double most = hold;
  const std::size_t stride =
      std::max<std::size_t>(1, ux_.size() / static_cast<std::size_t>(tuning_.retreat_directions));
  for (std::size_t i = 0; i < ux_.size(); i += stride) {
    for (const double steps : {1.0, 3.0}) {
      const Outcome o =
          outcome(look, world, look.centre + steps * look.step * Vec2{ux_[i], uy_[i]});
      if (o.on_path <= 0 || o.worth() <= most) continue;
      most = o.worth();
      found = i;
    }
  }
  return found ? std::optional(heading(*found)) : std::nullopt;
}

}  // namespace microswarm::navigation
