// SPDX-License-Identifier: Apache-2.0
#include "microswarm/navigation/radar/escape_search.hpp"

#include <algorithm>
#include <utility>

namespace microswarm {

EscapeSearch::Trace EscapeSearch::begin(Vec2 first, double until) {
  const Foresight::Schedule& schedule = seen_.schedule(until);
  Trace trace{.outcome = {.until_contact = 0, .least = tuning_.counted_gap, .last = 0}};
  const std::span<const Foresight::Instant> all = schedule.instants;
  follow(trace, {first, until, {}}, all.first(schedule.shared), tuning_.counted_gap);
  trace.instants = schedule.shared;
  return trace;
}

void EscapeSearch::consider(const EscapeWay& way, Trace trace) {
  if (trace.is_hopeless || is_hopeless(trace, tuning_.counted_gap)) return;
  if (!trace.blocked) {
    const std::span<const Foresight::Instant> all = seen_.schedule(way.until).instants;
    double last = tuning_.counted_gap;
    if (only_gaps_count() || seen_.walls_from() >= seen_.end()) {  // it gets to its end, or loses
      const Foresight::Instant& end = all.back();
      last = seen_.gap(seen_.start().place + way.at(end.t), end, last, Foresight::Error::none);
      if (only_gaps_count() && is_contact(last, end.t)) return;
      trace.outcome.least = std::min(trace.outcome.least, last);
      if (is_hopeless(trace, last)) return;
    }
    follow(trace, way, all.subspan(trace.instants), last);
    if (trace.is_hopeless) return;
  }
  const EscapeOutcome& o = trace.outcome;
  if (o.until_contact != outcome_.until_contact ? o.until_contact < outcome_.until_contact
                                                : !(o.worth() > bar()))
    return;
  outcome_ = o;
  best_ = way;
}

void EscapeSearch::prefer(double time, double gap) {
  outcome_.until_contact = std::min(outcome_.until_contact + time, seen_.end());
  outcome_.least += gap;
  outcome_.last += gap;
}

/// Goes on along the way until a wall, or until it cannot be the best, given that its last gap is
/// at most `most_last` if it is free.
void EscapeSearch::follow(Trace& trace, const EscapeWay& way,
                          std::span<const Foresight::Instant> instants, double most_last) const {
  if (trace.blocked || instants.empty()) return;
  const Vec2 start = seen_.start().place;
  EscapeOutcome& out = trace.outcome;
  Vec2 last = start;
  if (trace.instants > 0)
    last = start + way.at(seen_.schedule(way.until).instants[trace.instants - 1].t);
  for (const Foresight::Instant& i : instants) {
    const Vec2 p = start + way.at(i.t);
    const Vec2 from = std::exchange(last, p);
    if (!seen_.is_free_of_walls(from, p, i.t)) {
      trace.blocked = true;
      return;
    }
    out.last = seen_.gap(p, i, tuning_.counted_gap, Foresight::Error::none);
    out.least = std::min(out.least, out.last);
    trace.touched = trace.touched || is_contact(out.last, i.t);
    if (!trace.touched) out.until_contact = i.t;
    trace.is_hopeless = is_hopeless(trace, most_last);
    if (trace.is_hopeless) return;
  }
}

bool EscapeSearch::is_hopeless(const Trace& trace, double most_last) const {
  const EscapeOutcome& out = trace.outcome;
  const double longest = trace.touched || trace.blocked ? out.until_contact : seen_.end();
  if (longest != outcome_.until_contact) return longest < outcome_.until_contact;
  return out.least + most_last <= bar();
}

}  // namespace microswarm
