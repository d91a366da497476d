// SPDX-License-Identifier: Apache-2.0
#include "microswarm/navigation/radar/safety_filter.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "microswarm/core/maths/angles.hpp"

namespace microswarm {
namespace {

constexpr double tie = 1e-6;

Vec2 velocity_of(const Command& command) { return command.speed * unit_vector(command.heading); }

std::vector<Vec2> velocities_of(const SafetyFilterParams& params, double speed) {
  std::vector<Vec2> velocities(1);
  for (int k = 0; k < params.directions; ++k)
    velocities.push_back(speed * unit_vector(wrap(2 * pi * k / params.directions)));
  return velocities;
}

}  // namespace

SafetyFilter::SafetyFilter(const SafetyFilterParams& params, double speed)
    : params_(params),
      speed_(speed),
      tracker_(params.tracker),
      seen_(params, speed),
      escapes_(velocities_of(params, speed), speed) {
  choices_.reserve(static_cast<std::size_t>(params_.tuning.refinement * params_.directions) + 1);
}

void SafetyFilter::update(const Observation& observation) {
  tracker_.update(observation, seen_.range() + (observation.swarm ? observation.swarm->radius : 0));
}

std::optional<Command> SafetyFilter::filter(const Command& wanted, const Start& start,
                                            const Snapshot& world, double tick) {
  seen_.look(start, world, tracker_, std::max(speed_, std::abs(wanted.speed)));
  std::optional<Command> instead;
  if (!seen_.empty()) instead = checked(wanted, std::max(tick, params_.commitment));
  if (!instead) waited_ = 0;
  if (instead && instead->speed == 0) waited_ += tick;
  const Command& driven = instead ? *instead : wanted;
  if (driven.speed > 0) course_ = driven.heading;
  return instead;
}

std::optional<Command> SafetyFilter::checked(const Command& wanted, double lasting) {
  std::optional<Command> instead;
  if (!escapes_.has_free(seen_, velocity_of(wanted), lasting, 1)) {
    instead = nearest_safe(wanted, lasting);
    if (!instead) return best_manoeuvre();
  }
  committed_.reset();
  return instead;
}

// To hold counts as turning across, as it gets no nearer, and as more the longer it lasts: before
// what stands it would last for ever.
std::optional<Command> SafetyFilter::nearest_safe(const Command& wanted, double lasting) {
  const double course = course_.value_or(wanted.heading);
  choices_.assign(1, {0.5 * pi + params_.tuning.impatience * waited_, {wanted.heading, 0}});
  const int count = params_.tuning.refinement * params_.directions;
  for (int k = 0; k < count; ++k) {
    const double heading = wrap(wanted.heading + 2 * pi * k / count);
    // Between the two all turn the same: then what is nearer to the wanted one comes first.
    const double turn =
        (1 + tie) * turn_between(heading, wanted.heading) + turn_between(heading, course);
    choices_.push_back({turn, {heading, speed_}});
  }
  std::sort(choices_.begin(), choices_.end());
  for (const Choice& choice : choices_)
    if (escapes_.has_free(seen_, velocity_of(choice.command), lasting, params_.tuning.min_escapes))
      return choice.command;
  return std::nullopt;
}

Command SafetyFilter::best_manoeuvre() {
  const SafetyFilterTuning& tuning = params_.tuning;
  const auto velocities = escapes_.velocities();
  EscapeSearch search(seen_, tuning);
  const double now = seen_.start().time;
  if (committed_) {
    const double until = committed_->way.until - (now - committed_->time);
    search.consider({committed_->way.first, std::max(until, 0.0), committed_->way.second});
    search.prefer(tuning.switch_time, tuning.switch_gap);
  }
  for (const Vec2 v : velocities) search.consider({{}, 0, v});
  for (const Vec2 v : velocities) {
    for (const double t : tuning.hold_times) search.consider({{}, t, v});
    for (const double t : tuning.run_times) search.consider({v, t, {}});
  }
  for (std::size_t i = 1; i < velocities.size(); i += 2) {
    begun_.clear();
    for (const double t : tuning.turn_times) begun_.push_back(search.begin(velocities[i], t));
    for (std::size_t j = 1; j < velocities.size(); j += 2)
      for (std::size_t k = 0; k < begun_.size() && i != j; ++k)
        search.consider({velocities[i], tuning.turn_times[k], velocities[j]}, begun_[k]);
  }
  const EscapeWay& chosen = search.best();
  committed_ = Committed{chosen, now};
  const Vec2 begin = chosen.until > 0 ? chosen.first : chosen.second;
  const double speed = norm(begin);
  return {speed > 0 ? heading_of(begin) : 0, speed};
}

}  // namespace microswarm
