// SPDX-License-Identifier: Apache-2.0
#include "microswarm/navigation/radar/escape_fan.hpp"

#include <algorithm>
#include <utility>

#include "microswarm/core/execution/each_cpu.hpp"

namespace microswarm {
namespace {

using Instant = Foresight::Instant;

constexpr double doubt = 1e-9;  // relative, of distances

/// Places that a fan is at, relative to a body.
struct FanPlaces {
  const double* x;  ///< of the velocities [µm/s]
  const double* y;
  std::size_t count;
  double after;  ///< since the turn [s]
  Vec2 turn;     ///< displacement there [µm]
  Vec2 start, body;
};

struct Screened {
  std::int64_t open = 0, doubted = 0;
};

/// Blocks places nearer than √`near`, doubts others nearer than √`far` [µm²].
MICROSWARM_EACH_CPU Screened screen_places(const FanPlaces& places, double near, double far,
                                           std::int64_t* blocked, std::int64_t* doubted) {
  const FanPlaces at = places;
  std::int64_t open = 0;
  std::int64_t doubts = 0;
  for (std::size_t k = 0; k < at.count; ++k) {
    const double x = at.start.x + (at.turn.x + at.after * at.x[k]) - at.body.x;
    const double y = at.start.y + (at.turn.y + at.after * at.y[k]) - at.body.y;
    const double squared = x * x + y * y;
    const std::int64_t is_blocked = blocked[k] | static_cast<std::int64_t>(squared < near);
    const std::int64_t is_doubted = (1 - is_blocked) & static_cast<std::int64_t>(squared < far);
    blocked[k] = is_blocked;
    doubted[k] = is_doubted;
    open += 1 - is_blocked;
    doubts += is_doubted;
  }
  return {open, doubts};
}

double squared_if_positive(double v) { return v > 0 ? v * v : 0; }

}  // namespace

bool is_free(const Foresight& seen, const EscapeWay& way, std::span<const Instant> instants,
             double before) {
  const Vec2 start = seen.start().place;
  Vec2 last = start + way.at(before);
  for (const Instant& i : instants) {
    const Vec2 p = start + way.at(i.t);
    const Vec2 from = std::exchange(last, p);
    if (!seen.is_clear(p, i) || !seen.is_free_of_walls(from, p, i.t)) return false;
  }
  return true;
}

EscapeFan::EscapeFan(std::vector<Vec2> velocities, double speed)
    : velocities_(std::move(velocities)),
      speed_(speed),
      blocked_(velocities_.size()),
      doubted_(velocities_.size()) {
  for (const Vec2 v : velocities_) {
    x_.push_back(v.x);
    y_.push_back(v.y);
  }
}

bool EscapeFan::has_free(Foresight& seen, Vec2 begin, double until, int count) {
  const Foresight::Schedule& schedule = seen.schedule(until);
  const std::span<const Instant> all = schedule.instants;
  const EscapeWay shared{begin, until, {}};
  if (!is_free(seen, shared, all.first(schedule.shared), 0)) return false;
  const auto rest = all.subspan(schedule.shared);
  const double before = schedule.shared > 0 ? all[schedule.shared - 1].t : 0;
  const auto goes_on = [&](std::size_t k) {
    return is_free(seen, {begin, until, velocities_[k]}, rest, before);
  };
  if (count == 1 && goes_on(last_)) return true;
  if (!screen(seen, shared, rest, count)) return false;
  const bool is_known = seen.all_convex() && seen.walls_from() >= seen.end();
  int found = 0;
  for (std::size_t k = 0; k < velocities_.size() && found < count; ++k) {
    if (blocked_[k] != 0 || !(is_known || goes_on(k))) continue;
    last_ = k;
    ++found;
  }
  return found >= count;
}

/// Blocks what meets bodies; false once fewer than `count` velocities are left.
bool EscapeFan::screen(const Foresight& seen, const EscapeWay& begin,
                       std::span<const Instant> instants, std::int64_t count) {
  std::fill(blocked_.begin(), blocked_.end(), 0);
  for (const Instant& i : instants)
    for (const Foresight::Near& body : seen.near(i))
      if (meet(seen, body, begin, i) < count) return false;
  return static_cast<std::int64_t>(velocities_.size()) >= count;
}

/// Blocks what meets this body; gives the number of velocities left.
std::int64_t EscapeFan::meet(const Foresight& seen, const Foresight::Near& body,
                             const EscapeWay& begin, const Instant& at) {
  const double after = std::max(0.0, at.t - begin.until);
  const FanPlaces places{
      x_.data(),          y_.data(),  x_.size(), after, std::min(at.t, begin.until) * begin.first,
      seen.start().place, body.centre};
  const double touch = body.touch[static_cast<std::size_t>(Foresight::Error::bounded)];
  const double contact = body.outline->radius + touch + at.required;
  const double far = std::max(0.0, contact) * (1 + doubt) + doubt;
  const Vec2 off = places.start + places.turn - places.body;
  const double reach = (far + after * speed_) * (1 + doubt);
  if (squared_norm(off) > reach * reach) return static_cast<std::int64_t>(x_.size());
  const double near = body.outline->edges.empty() ? contact * (1 - doubt) - doubt : 0;
  Screened left =
      screen_places(places, squared_if_positive(near), far * far, blocked_.data(), doubted_.data());
  for (std::size_t k = 0; k < x_.size() && left.doubted > 0; ++k) {
    if (doubted_[k] == 0) continue;
    --left.doubted;
    const EscapeWay way{begin.first, begin.until, velocities_[k]};
    if (seen.is_clear(seen.start().place + way.at(at.t), at)) continue;
    blocked_[k] = 1;
    --left.open;
  }
  return left.open;
}

}  // namespace microswarm
