// SPDX-License-Identifier: Apache-2.0
#include "microswarm/navigation/safe_interval/imminent_check.hpp"

#include <algorithm>
#include <cmath>

#include "microswarm/core/maths/angles.hpp"

namespace microswarm::navigation {
namespace {

constexpr int escapes = 16;             // directions of an escape
constexpr int first_legs = 18;          // directions of the first leg of a manoeuvre
constexpr double counted_gap = 40;      // [µm], gap above which two manoeuvres are equally good
constexpr double contact_gap = 0.5;     // [µm]
constexpr double hold_turn = 0.5 * pi;  // turn to which a hold is equivalent

}  // namespace

ImminentCheck::ImminentCheck(const ImminentTuning& tuning, const SwarmLimits& swarm, double speed,
                             double tick)
    : tuning_(tuning),
      turn_rate_(swarm.max_turn_rate),
      speed_(speed),
      tick_(tick),
      committed_time_(std::max(tuning.commitment, tick)) {
  choices_.reserve(2 * static_cast<std::size_t>(tuning.directions) + 1);
}

void ImminentCheck::begin(const Situation& situation) {
  now_ = situation;
  const ObstacleForecast& forecast = *now_.forecast;
  samples_ = std::min(forecast.near_samples(),
                      static_cast<int>(std::ceil(tuning_.horizon / forecast.step())));
  committed_ =
      std::clamp(static_cast<int>(std::ceil(committed_time_ / forecast.step())), 1, samples_);
  commanded_ = std::clamp(static_cast<int>(std::ceil(tick_ / forecast.step())), 1, committed_);
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

double ImminentCheck::required(const Near& near, int sample) const {
  const double t = sample * now_.forecast->step();
  return std::min(tuning_.gap + near.noise_gap + tuning_.gap_rate * t,
                  near.present + tuning_.recovery_rate * t);
}

ImminentCheck::Outcome ImminentCheck::roll(Pose2 from, const Command& command, int first, int last,
                                           bool in_contact_only, Turned turned) const {
  const ObstacleForecast& forecast = *now_.forecast;
  Outcome out{first, counted_gap, from};
  const Command given = now_.response.command_for(command, speed_);
  bool stands = false;
  for (int s = first; s < last; ++s) {
    // The commitment ends at the goal; what comes near there later can be escaped from.
    const bool has_arrived =
        first == 0 && distance(out.end.position, now_.goal.centre) <= now_.goal.radius;
    Pose2 next = has_arrived || stands
                     ? out.end
                     : now_.response.step(out.end, given, turn_rate_, forecast.step());
    Segment move{out.end.position, next.position};
    if (!stands && !(move.a == move.b) && !now_.map->is_free(move, now_.wall_clearance)) {
      if (s == first) out.least = -infinity;  // no start at all
      if (first > 0 || s < commanded_) return out;
      // The next command stops it before the wall.
      stands = true;
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

bool ImminentCheck::leaves_escape(const Pose2& from, const Command& command, int first) {
  const auto is_free = [&](const Command& c) {
    return roll(from, c, first, samples_, false).until == samples_;
  };
  if (is_free(command) || is_free({from.heading, 0})) return true;
  if (is_free(direction(last_escape_, escapes))) return true;
  for (int k = 0; k < escapes; ++k) {
    if (!is_free(direction(k, escapes))) continue;
    last_escape_ = k;
    return true;
  }
  return false;
}

bool ImminentCheck::is_safe(const Command& command, Turns turns) {
  const Outcome first = roll(now_.pose, command, 0, committed_, false);
  if (first.until < committed_) return false;
  if (turns == Turns::of_any_body)
    for (std::size_t k = 0; k < near_.size(); ++k)
      if (const int n = near_[k].turned; roll(now_.pose, command, 0, n, false, k).until < n)
        return false;
  return leaves_escape(first.end, command, committed_);
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
  for (int k = 0; k < tuning_.directions; ++k) {
    const double heading = wrap(wanted.heading + 2 * pi * k / tuning_.directions);
    add({heading, speed_}, 0);
    add({heading, 0.4 * speed_}, 0.25);
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
  Command best{now_.pose.heading, 0};
  double best_score = -infinity;
  const auto score = [&](const Outcome& o) { return 1e3 * o.until + o.least; };
  const auto consider = [&](const Command& first) {
    const Outcome begin = roll(now_.pose, first, 0, committed_, true);
    double found = score(begin);
    if (begin.until == committed_)
      for (int k = -1; k < escapes; ++k) {
        const Command second = k < 0 ? Command{begin.end.heading, 0} : direction(k, escapes);
        Outcome rest = roll(begin.end, second, committed_, samples_, true);
        rest.least = std::min(rest.least, begin.least);
        found = std::max(found, score(rest));
      }
    const bool goes_on =
        (last.speed > 0) == (first.speed > 0) &&
        (last.speed <= 0 || turn_between(last.heading, first.heading) < same_course);
    if (goes_on) found += tuning_.switch_gap;
    if (found <= best_score) return;
    best_score = found;
    best = first;
  };
  consider(best);
  if (last.speed > 0) consider(last);
  for (int k = 0; k < first_legs; ++k) consider(direction(k, first_legs));
  return best;
}

}  // namespace microswarm::navigation
