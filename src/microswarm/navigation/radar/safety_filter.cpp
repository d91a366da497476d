// SPDX-License-Identifier: Apache-2.0
#include "microswarm/navigation/radar/safety_filter.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "microswarm/core/maths/angles.hpp"

namespace microswarm::navigation {
namespace {

constexpr double tie = 1e-6;
constexpr std::size_t sectors = 8;  // of the circle, from the wanted heading on
constexpr double half_sector = pi / sectors;

Vec2 escape_velocity(const Command& command) {
  return command.speed * unit_vector(command.heading);
}

std::vector<Vec2> escape_velocities(const SafetyFilterParams& params, double speed) {
  std::vector<Vec2> velocities(1);
  velocities.reserve(static_cast<std::size_t>(params.directions) + 1);
  for (int k = 0; k < params.directions; ++k)
    velocities.push_back(speed * unit_vector(wrap(2 * pi * k / params.directions)));
  return velocities;
}

std::vector<Vec2> every_other(std::span<const Vec2> velocities) {
  std::vector<Vec2> some;
  some.reserve(velocities.size() / 2);
  for (std::size_t i = 1; i < velocities.size(); i += 2) some.push_back(velocities[i]);
  return some;
}

}  // namespace

SafetyFilter::SafetyFilter(const SafetyFilterParams& params, double speed)
    : params_(params),
      speed_(speed),
      tracker_(params.tracker),
      seen_(params, speed),
      escapes_(escape_velocities(params, speed), speed),
      turns_(every_other(escapes_.velocities()), speed) {
  const SafetyFilterTuning& tuning = params_.tuning;
  choices_.reserve(static_cast<std::size_t>(tuning.refinement * params_.directions) + 1);
  bundles_.resize(
      1 + std::max(tuning.hold_times.size() + tuning.run_times.size(), tuning.turn_times.size()));
  for (EscapeSearch::Bundle& bundle : bundles_)
    bundle.candidates.reserve(escapes_.velocities().size());
}

void SafetyFilter::update(const Observation& observation) {
  tracker_.update(observation, seen_.range() + (observation.swarm ? observation.swarm->radius : 0));
}

std::optional<Command> SafetyFilter::filter(const Command& wanted, const Start& start,
                                            const Snapshot& world, double tick) {
  seen_.predict(start, world, tracker_, std::max(speed_, std::abs(wanted.speed)));
  const std::optional<Command> instead = checked(wanted, std::max(tick, params_.commitment));
  if (!instead) waited_ = 0;
  if (instead && instead->speed == 0) waited_ += tick;
  const Command& driven = instead ? *instead : wanted;
  if (driven.speed > 0) course_ = driven.heading;
  return instead;
}

std::optional<Command> SafetyFilter::checked(const Command& wanted, double lasting) {
  std::optional<Command> instead;
  if (!escapes_.has_free(seen_, escape_velocity(wanted), lasting, 1)) {
    instead = nearest_safe(wanted, lasting);
    if (!instead) return best_manoeuvre();
  }
  committed_.reset();
  return instead;
}

// Usually the first choice or none leaves escapes. So after the first failure all choices are
// excluded by one test if possible, later the sector of each that fails. The middle of a sector's
// chord is no farther from any velocity in the sector than from the chord's ends.
std::optional<Command> SafetyFilter::nearest_safe(const Command& wanted, double lasting) {
  const int count = params_.tuning.min_escapes;
  const Vec2 half = unit_vector(half_sector);
  list_choices(wanted);
  std::array<bool, sectors> tried{};
  std::array<bool, sectors> excluded{};
  bool is_first = true;
  for (const auto& [turn, command, sector] : choices_) {
    if (sector && excluded[*sector]) continue;
    if (escapes_.has_free(seen_, escape_velocity(command), lasting, count)) return command;
    if (std::exchange(is_first, false) && escapes_.excludes(seen_, {}, speed_, lasting, count))
      return std::nullopt;
    if (!sector || std::exchange(tried[*sector], true)) continue;
    const double middle = wanted.heading + static_cast<double>(2 * *sector + 1) * half_sector;
    const Vec2 begin = speed_ * half.x * unit_vector(wrap(middle));
    excluded[*sector] = escapes_.excludes(seen_, begin, speed_ * half.y, lasting, count);
  }
  return std::nullopt;
}

// A hold counts as a turn by 90°, since it makes no progress, and as more the longer it lasts:
// otherwise it would never end in front of a standing obstacle.
void SafetyFilter::list_choices(const Command& wanted) {
  const double course = course_.value_or(wanted.heading);
  const double hold = 0.5 * pi + params_.tuning.impatience * waited_;
  choices_.assign(1, {hold, {wanted.heading, 0}, std::nullopt});
  const int count = params_.tuning.refinement * params_.directions;
  for (int k = 0; k < count; ++k) {
    const double heading = wrap(wanted.heading + 2 * pi * k / count);
    // All headings between the two have the same sum of turns; the factor prefers the wanted one.
    const double turn =
        (1 + tie) * turn_between(heading, wanted.heading) + turn_between(heading, course);
    const auto sector = static_cast<std::size_t>(k) * sectors / static_cast<std::size_t>(count);
    choices_.push_back({turn, {heading, speed_}, sector});
  }
  std::sort(choices_.begin(), choices_.end());
}

Command SafetyFilter::best_manoeuvre() {
  const SafetyFilterTuning& tuning = params_.tuning;
  EscapeSearch search(seen_, tuning);
  const double now = seen_.start().time;
  if (committed_) {
    const double until = committed_->trajectory.until - (now - committed_->time);
    search.consider(
        {committed_->trajectory.first, std::max(until, 0.0), committed_->trajectory.second});
    search.prefer(tuning.switch_time, tuning.switch_gap);
  }
  std::size_t count = 0;
  const auto consider = [&](const EscapeFan& fan) {
    for (std::size_t k = 0; k < fan.velocities().size(); ++k)
      for (std::size_t i = 0; i < count; ++i) search.consider(bundles_[i], fan, k);
    count = 0;
  };
  search.turns({}, 0, escapes_, bundles_[count++]);
  consider(escapes_);
  for (const double t : tuning.hold_times) search.turns({}, t, escapes_, bundles_[count++]);
  for (const double t : tuning.run_times) search.runs(t, escapes_, bundles_[count++]);
  consider(escapes_);
  for (const Vec2 first : turns_.velocities()) {
    for (const double t : tuning.turn_times) search.turns(first, t, turns_, bundles_[count++]);
    consider(turns_);
  }
  const TwoLegTrajectory& chosen = search.best();
  committed_ = Committed{chosen, now};
  const Vec2 begin = chosen.until > 0 ? chosen.first : chosen.second;
  const double speed = norm(begin);
  return {speed > 0 ? heading_along(begin) : 0, speed};
}

}  // namespace microswarm::navigation
