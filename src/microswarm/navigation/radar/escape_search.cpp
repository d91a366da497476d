// SPDX-License-Identifier: Apache-2.0
#include "microswarm/navigation/radar/escape_search.hpp"

#include <algorithm>
#include <utility>

namespace microswarm::navigation {
namespace {

constexpr double gap_rounding = 1e-6;  // [µm]

}  // namespace

EscapeSearch::Trace EscapeSearch::begin(Vec2 first, double until) {
  const SampleTimes& schedule = seen_.sample_times(until);
  Trace trace = empty_trace();
  const std::span<const SampleTime> all = schedule.times;
  follow(trace, {first, until, {}}, all.first(schedule.shared), tuning_.counted_gap);
  trace.times = schedule.shared;
  return trace;
}

void EscapeSearch::consider(const TwoLegTrajectory& trajectory, Trace trace) {
  if (trace.is_hopeless || is_hopeless(trace, tuning_.counted_gap)) return;
  if (!trace.blocked) {
    const std::span<const SampleTime> all = seen_.sample_times(trajectory.until).times;
    double last = tuning_.counted_gap;
    if (only_gaps_count() || seen_.walls_from() >= seen_.end()) {  // it reaches its end, or loses
      const SampleTime& end = all.back();
      last = seen_.gap(seen_.start().position + trajectory.at(end.t), end, last,
                       ReachableObstacles::MotionError::none);
      if (only_gaps_count() && is_contact(last, end.t)) return;
      trace.outcome.least = std::min(trace.outcome.least, last);
      if (is_hopeless(trace, last)) return;
    }
    follow(trace, trajectory, all.subspan(trace.times), last);
    if (trace.is_hopeless) return;
  }
  const EscapeOutcome& o = trace.outcome;
  if (o.until_contact != outcome_.until_contact ? o.until_contact < outcome_.until_contact
                                                : !(o.score() > score_to_beat()))
    return;
  outcome_ = o;
  best_ = trajectory;
}

void EscapeSearch::turns(Vec2 first, double until, EscapeFan& fan, Bundle& out) {
  out.trajectories = {{first, until, {}}, false};
  out.prefix = begin(first, until);
  out.candidates.assign(fan.velocities().size(), out.prefix.blocked ? 1 : 0);
  if (out.prefix.is_hopeless || is_hopeless(out.prefix, tuning_.counted_gap)) return;
  if (!out.prefix.blocked) screen(fan, out);
  for (std::size_t k = 0; k < out.candidates.size() && until > 0; ++k)
    if (fan.velocities()[k] == first) out.candidates[k] = 0;
}

void EscapeSearch::runs(double until, EscapeFan& fan, Bundle& out) {
  out.trajectories = {{{}, until, {}}, true};
  out.prefix = empty_trace();
  out.candidates.assign(fan.velocities().size(), 0);
  screen(fan, out);
}

/// Keeps the trajectories of the fan that may become the best. Excluded are those that touch a body
/// sooner than the best one and, once only gaps count, those whose minimum gap is too small for any
/// final gap.
void EscapeSearch::screen(EscapeFan& fan, Bundle& out) const {
  const std::span<const SampleTime> all = seen_.sample_times(out.trajectories.common.until).times;
  const auto later = std::find_if(
      all.begin(), all.end(), [&](const SampleTime& i) { return i.t > outcome_.until_contact; });
  const auto upto = static_cast<std::size_t>(later - all.begin());
  const std::size_t from = std::min(out.prefix.times, upto);
  if (!fan.may_keep(seen_, out.trajectories, all.subspan(from, upto - from), least())) return;
  for (std::size_t k = 0; k < out.candidates.size(); ++k)
    out.candidates[k] = fan.is_kept(k) ? 1 : 0;
}

RequiredGap EscapeSearch::least() const {
  const double floor = only_gaps_count() ? score_to_beat() - tuning_.counted_gap : -infinity;
  return {tuning_.contact_gap - gap_rounding, tuning_.contact_gap_rate, floor - gap_rounding};
}

void EscapeSearch::consider(const Bundle& bundle, const EscapeFan& fan, std::size_t velocity) {
  if (bundle.candidates[velocity] == 0) return;
  const TwoLegTrajectory trajectory = bundle.trajectories[fan.velocities()[velocity]];
  consider(trajectory, bundle.trajectories.first_varies ? begin(trajectory.first, trajectory.until)
                                                        : bundle.prefix);
}

void EscapeSearch::prefer(double time, double gap) {
  outcome_.until_contact = std::min(outcome_.until_contact + time, seen_.end());
  outcome_.least += gap;
  outcome_.last += gap;
}

/// Follows the trajectory until a wall, or until it cannot become the best, given that its final
/// gap is at most `max_last_gap` if it is free.
void EscapeSearch::follow(Trace& trace, const TwoLegTrajectory& trajectory,
                          std::span<const SampleTime> times, double max_last_gap) const {
  if (trace.blocked || times.empty()) return;
  const Vec2 start = seen_.start().position;
  EscapeOutcome& out = trace.outcome;
  Vec2 last = start;
  if (trace.times > 0)
    last = start + trajectory.at(seen_.sample_times(trajectory.until).times[trace.times - 1].t);
  for (const SampleTime& i : times) {
    const Vec2 p = start + trajectory.at(i.t);
    const Vec2 from = std::exchange(last, p);
    if (!seen_.is_free_of_walls(from, p, i.t)) {
      trace.blocked = true;
      return;
    }
    out.last = seen_.gap(p, i, tuning_.counted_gap, ReachableObstacles::MotionError::none);
    out.least = std::min(out.least, out.last);
    trace.touched = trace.touched || is_contact(out.last, i.t);
    if (!trace.touched) out.until_contact = i.t;
    trace.is_hopeless = is_hopeless(trace, max_last_gap);
    if (trace.is_hopeless) return;
  }
}

bool EscapeSearch::is_hopeless(const Trace& trace, double max_last_gap) const {
  const EscapeOutcome& out = trace.outcome;
  const double longest = trace.touched || trace.blocked ? out.until_contact : seen_.end();
  if (longest != outcome_.until_contact) return longest < outcome_.until_contact;
  return out.least + max_last_gap <= score_to_beat();
}

}  // namespace microswarm::navigation
