// SPDX-License-Identifier: Apache-2.0
#include "microswarm/navigation/safe_interval/imminent_check.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "microswarm/core/maths/angles.hpp"

namespace microswarm::navigation {
namespace {

constexpr int directions = 16;          // of an escape
constexpr int first_legs = 18;          // directions of the first leg of a manoeuvre
constexpr double counted_gap = 40;      // [µm], gap above which two manoeuvres are equally good
constexpr double contact_gap = 0.5;     // [µm]
constexpr double hold_turn = 0.5 * pi;  // turn to which a hold is equivalent

}  // namespace

ImminentCheck::ImminentCheck(const ImminentTuning& tuning, const SwarmLimits& swarm, double speed,
                             double tick)
    : tuning_(tuning),
      turning_{swarm.max_turn_rate},
      speed_(speed),
      tick_(tick),
      committed_time_(std::max(tuning.commitment, tick)),
      escapes_(std::isfinite(swarm.max_turn_rate) ? 2 * directions : directions) {
  choices_.reserve(3 * static_cast<std::size_t>(tuning.directions) + 3);
}

void ImminentCheck::begin(const Situation& situation) {
  now_ = situation;
  const ObstacleForecast& forecast = *now_.forecast;
  samples_ = std::min(forecast.near_samples(),
                      static_cast<int>(std::ceil(tuning_.horizon / forecast.step())));
  committed_ =
      std::clamp(static_cast<int>(std::ceil(committed_time_ / forecast.step())), 1, samples_);
  commanded_ = std::clamp(static_cast<int>(std::ceil(tick_ / forecast.step())), 1, committed_);
  const double passed = situation.time - std::exchange(time_, situation.time);
  kept_ = std::exchange(found_, std::nullopt);
  if (!(passed > 0 && passed < 1.5 * tick_)) kept_.reset();
  if (kept_) kept_->switch_time -= passed, kept_->checked -= passed;
  present_hollow_gap_ =
      forecast.hollow_clearance(now_.pose.position, now_.radius + counted_gap) - now_.radius;
  near_.clear();
  const double own = speed_ * samples_ * forecast.step();
  for (std::size_t i = 0; i < forecast.size(); ++i) {
    double moved = 0;
    for (int s = 0; s < samples_; s += 4)
      moved = std::max(moved, distance(forecast.at(0, i).centre,
                                       forecast.at(std::min(s + 4, samples_), i).centre));
    const double present = forecast.present_gap(i);
    if (present > own + moved + counted_gap) continue;
    const double closing = (speed_ + forecast.speed(i)) * (committed_time_ + forecast.late());
    Near near{i, tuning_.noise_gain * forecast.noise(i), present};
    if (const double v = forecast.speed(i); v > 0 && v < speed_ && present < closing) {
      const double unseen = std::min(tuning_.hidden_turn * forecast.noise(i) / v, committed_time_);
      const double turned = std::ceil((tuning_.turn_time + unseen) / forecast.step());
      near.turned = std::min(samples_, static_cast<int>(turned));
    }
    near_.push_back(near);
  }
}

Command ImminentCheck::direction(int k, int count, double share) const {
  return {wrap(now_.pose.heading + 2 * pi * k / count), share * speed_};
}

double ImminentCheck::time_of(int sample) const { return sample * now_.forecast->step(); }

int ImminentCheck::samples_until(double time) const {
  return static_cast<int>(std::lround(time / now_.forecast->step()));
}

double ImminentCheck::slow_speed() const { return planning::TurnFirst::slow_share * speed_; }

bool ImminentCheck::turns_first(const Leg& leg, double given, const Pose2& pose) const {
  return leg.turns_first && turning_.applies(turn_between(given, pose.heading));
}

/// Escape k: in one direction each, at full speed and, with a limited turn rate, turning first.
ImminentCheck::Leg ImminentCheck::escape(int k) const {
  return {direction(k % directions, directions), k >= directions};
}

Command ImminentCheck::begin_of(const Manoeuvre& manoeuvre) const {
  const Leg& leg = samples_until(manoeuvre.switch_time) > 0 ? manoeuvre.first : manoeuvre.second;
  const double given = now_.response.command_for(leg.command, speed_).heading;
  if (!turns_first(leg, given, now_.pose)) return leg.command;
  return {leg.command.heading, std::min(leg.command.speed, slow_speed())};
}

double ImminentCheck::required(const Near& near, int sample) const {
  const double t = sample * now_.forecast->step();
  return std::min(tuning_.gap + near.noise_gap + tuning_.gap_rate * t,
                  near.present + tuning_.recovery_rate * t);
}

ImminentCheck::Outcome ImminentCheck::roll(Pose2 from, const Leg& leg, int first, int last,
                                           bool in_contact_only, Turned turned) const {
  const ObstacleForecast& forecast = *now_.forecast;
  Outcome out{first, counted_gap, from};
  const Command given = now_.response.command_for(leg.command, speed_);
  const Command slow{given.heading, std::min(given.speed, slow_speed())};
  bool stands = false;
  for (int s = first; s < last; ++s) {
    // The commitment ends at the goal; what comes near there later can be escaped from.
    const bool has_arrived =
        first == 0 && distance(out.end.position, now_.goal.centre) <= now_.goal.radius;
    Pose2 next =
        has_arrived || stands
            ? out.end
            : now_.response.step(out.end, turns_first(leg, given.heading, out.end) ? slow : given,
                                 turning_.turn_rate, forecast.step());
    Segment move{out.end.position, next.position};
    if (!stands && !(move.a == move.b) && !now_.map->is_free(move, now_.wall_clearance)) {
      if (s == first) out.least = -infinity;  // no start at all
      if (first > 0 || s < commanded_) return out;
      // The next command stops it before the wall.
      stands = true;
      out.stood = s;
      next = out.end;
      move.b = move.a;
    }
    if (!forecast.hollow().empty()) {
      const double away = forecast.hollow_clearance(next.position, now_.radius + counted_gap);
      const double gap = away - now_.radius;
      const double needed = in_contact_only ? contact_gap : tuning_.gap;
      const double recovered = tuning_.recovery_rate * (s + 1) * forecast.step();
      if (gap < std::min(needed, present_hollow_gap_ + (in_contact_only ? 0 : recovered)))
        return out;
      out.least = std::min(out.least, gap);
    }
    for (std::size_t k = 0; k < near_.size(); ++k) {
      const Near& near = near_[k];
      const bool turns = turned == k;
      const double gap = turns
                             ? forecast.gap_if_turned(move, s, near.index, now_.radius, counted_gap)
                             : forecast.gap_along(move, s, near.index, now_.radius, counted_gap);
      out.least = std::min(out.least, gap);
      const double touching = contact_gap + (turns ? near.noise_gap : 0);
      if (gap < (in_contact_only || turns ? std::min(touching, near.present) : required(near, s)))
        return out;
    }
    out.end = next;
    out.until = s + 1;
  }
  return out;
}

ImminentCheck::Outcome ImminentCheck::roll(const Manoeuvre& manoeuvre, bool in_contact_only) const {
  const int turn = std::clamp(samples_until(manoeuvre.switch_time), 0, samples_);
  const Outcome begin = roll(now_.pose, manoeuvre.first, 0, turn, in_contact_only);
  if (begin.until < turn) return begin;
  Outcome rest = roll(begin.end, manoeuvre.second, turn, samples_, in_contact_only);
  rest.least = std::min(rest.least, begin.least);
  return rest;
}

std::optional<ImminentCheck::Leg> ImminentCheck::escape_after(const Pose2& from,
                                                              const Command& command, int first) {
  const auto is_free = [&](const Leg& leg) {
    return roll(from, leg, first, samples_, false).until == samples_;
  };
  if (const Leg same{command}; is_free(same)) return same;
  if (const Leg hold{{from.heading, 0}}; is_free(hold)) return hold;
  if (const Leg last = escape(last_escape_); is_free(last)) return last;
  for (int k = 0; k < escapes_; ++k) {
    if (!is_free(escape(k))) continue;
    last_escape_ = k;
    return escape(k);
  }
  return std::nullopt;
}

std::optional<Command> ImminentCheck::kept_escape() {
  if (!kept_) return std::nullopt;
  const int until = roll(*kept_, false).until;
  const auto promised = static_cast<int>(std::floor(kept_->checked / now_.forecast->step() + 1e-9));
  if (until < std::max(promised, committed_)) return std::nullopt;
  kept_->checked = time_of(until);
  found_ = kept_;
  return begin_of(*kept_);
}

bool ImminentCheck::is_safe(const Command& command, Turns turns) {
  const Outcome first = roll(now_.pose, {command}, 0, committed_, false);
  if (first.until < committed_) return false;
  if (turns == Turns::of_any_body)
    for (std::size_t k = 0; k < near_.size(); ++k)
      if (const int n = near_[k].turned; roll(now_.pose, {command}, 0, n, false, k).until < n)
        return false;
  const auto escape = escape_after(first.end, command, committed_);
  if (!escape) return false;
  found_ = Manoeuvre{{command}, time_of(committed_), *escape, time_of(samples_)};
  if (first.stood)  // before a wall
    found_ =
        Manoeuvre{{command}, time_of(*first.stood), {{first.end.heading, 0}}, time_of(committed_)};
  return true;
}

std::optional<Command> ImminentCheck::nearest_safe(const Command& wanted, const Command& last,
                                                   Turns turns) {
  const double course = last.speed > 0 ? last.heading : wanted.heading;
  choices_.clear();
  const auto add = [&](const Command& command, double extra) {
    const double turn = turn_between(command.heading, wanted.heading) +
                        tuning_.turn_weight * turn_between(command.heading, course);
    choices_.push_back({turn + extra, command});
  };
  choices_.push_back({hold_turn, {now_.pose.heading, 0}});
  // The other way round, since the shorter turn may meet something.
  constexpr double half_way = 2;  // [rad]
  if (turning_.applies(turn_between(wanted.heading, now_.pose.heading)))
    for (const double turn : {half_way, -half_way})
      choices_.push_back({0.9 * hold_turn, {wrap(now_.pose.heading + turn), slow_speed()}});
  for (int k = 0; k < tuning_.directions; ++k) {
    const double heading = wrap(wanted.heading + 2 * pi * k / tuning_.directions);
    add({heading, speed_}, 0);
    add({heading, 0.4 * speed_}, 0.25);
    if (std::isfinite(turning_.turn_rate)) add({heading, slow_speed()}, 0.4);
  }
  std::sort(choices_.begin(), choices_.end(), [](const Choice& a, const Choice& b) {
    return a.cost != b.cost ? a.cost < b.cost : a.command.heading < b.command.heading;
  });
  for (const Choice& choice : choices_)
    if (is_safe(choice.command, turns)) return choice.command;
  return std::nullopt;
}

Command ImminentCheck::best_escape(const Command& last) {
  constexpr double same_course = 0.2;  // [rad]
  Manoeuvre best;
  double best_score = -infinity;
  const auto take = [&](const Manoeuvre& manoeuvre, const Outcome& o, bool goes_on) {
    const double score = 1e3 * o.until + o.least + (goes_on ? tuning_.switch_gap : 0);
    if (score <= best_score) return;
    best_score = score;
    best = manoeuvre;
  };
  const auto consider = [&](const Leg& first) {
    const bool goes_on =
        (last.speed > 0) == (first.command.speed > 0) &&
        (last.speed <= 0 || turn_between(last.heading, first.command.heading) < same_course);
    const Outcome begin = roll(now_.pose, first, 0, committed_, true);
    take({first, time_of(committed_), first}, begin, goes_on);
    if (begin.until < committed_) return;
    for (int k = -1; k < escapes_; ++k) {
      const Leg second = k < 0 ? Leg{{begin.end.heading, 0}} : escape(k);
      Outcome rest = roll(begin.end, second, committed_, samples_, true);
      rest.least = std::min(rest.least, begin.least);
      take({first, time_of(committed_), second}, rest, goes_on);
    }
  };
  if (kept_) take(*kept_, roll(*kept_, true), true);
  consider({{now_.pose.heading, 0}});
  if (last.speed > 0) consider({last});
  for (int k = 0; k < first_legs; ++k) consider({direction(k, first_legs)});
  if (std::isfinite(turning_.turn_rate))
    for (int k = 0; k < first_legs; ++k) consider({direction(k, first_legs), true});
  best.checked = time_of(samples_);
  found_ = best;
  return begin_of(best);
}

}  // namespace microswarm::navigation
