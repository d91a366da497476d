// SPDX-License-Identifier: Apache-2.0
#include "microswarm/rig/identify/identify_programme.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/errors/input_names.hpp"
#include "microswarm/core/maths/angles.hpp"
#include "microswarm/core/maths/maths.hpp"
#include "microswarm/rig/runtime/rig_checks.hpp"

namespace microswarm::rig {
namespace {

// Both senses from the middle, so that four squares' corners are met and the swarm ends there.
constexpr std::array<double, 8> square{0, 90, 180, 270, 180, 270, 0, 90};  // [°]
constexpr double square_share = 0.5;                                       // of the time
constexpr double reach_of_side = 2.1;  // 1.5 diagonals of the square: the gain is not known yet
constexpr double min_leg = 1.0, max_leg = 5.0, min_dwell = 1.2, max_dwell = 3.0;  // [s]
constexpr double lowest = 0.5, ratio = 1.12;                                      // of the sweep
constexpr std::size_t max_levels = 10;
constexpr double settling = 0.6;         // [s] of a leg in which the heading turns
constexpr double longest_way_back = 15;  // [s]

/// Rising frequencies up to `most`, the usual one among them.
std::vector<double> sweep_of(double usual, double most) {
  std::vector<double> all;
  const double step = std::max(ratio, maths::pow(most / (lowest * usual), 1.0 / (max_levels - 1)));
  for (double f = usual; f > lowest * usual / std::sqrt(step); f /= step) all.push_back(f);
  std::ranges::reverse(all);
  for (double f = usual * step; f < most * (1 + 1e-9); f *= step) all.push_back(f);
  if (all.back() < most / std::sqrt(step)) all.push_back(most);
  return all;
}

/// Maximum frequency of a rolling field in the sweep, always another than the usual one [Hz].
double sweep_limit(double usual, double most) { return std::max(most, 1.01 * usual); }

bool makes_field(Rig rig, double frequency) {
  rig.params.field.frequency = frequency;
  rig.params.field.step_out_frequency.reset();
  return check_field(rig).good;
}

/// Limit of the frequency by the rate of the outputs [Hz].
double rate_limit(const RigParams& rig) {
  constexpr double sends = 10;          // per turn
  constexpr double device_limit = 500;  // of a device that turns the field [Hz]
  return coil_input(rig) == actuation::CoilInput::waveform ? device_limit : rig.drive_rate / sends;
}

void allow_speed(experiment::Scenario& scenario, double speed) {
  if (scenario.robots) scenario.robots->max_speed = std::max(scenario.robots->max_speed, speed);
  std::visit([&](auto& swarm) { swarm.max_speed = std::max(swarm.max_speed, speed); },
             scenario.swarm);
}

}  // namespace

RigExperiment for_identification(RigExperiment on, double max_frequency) {
  constexpr double longest = 3600;  // [s]
  experiment::Scenario& scenario = on.experiment.scene.scenario;
  scenario.obstacles.clear();
  on.experiment.world.obstacles.clear();
  scenario.time_limit = longest;
  scenario.hold_at_goal = 0;
  actuation::FieldGeneratorParams& field = on.rig.params.field;
  field.step_out_frequency.reset();
  field.frequency = sweep_limit(field.frequency, max_frequency);
  if (field.kind == actuation::FieldKind::rolling) allow_speed(scenario, field.max_speed());
  return on;
}

double largest_frequency(const Rig& rig) {
  constexpr double most = 3, step = 1.05;  // of the usual one
  const double usual = rig.params.field.frequency;
  double frequency = std::min(most * usual, rate_limit(rig.params));
  while (frequency > usual && !makes_field(rig, frequency)) frequency /= step;
  return std::max(frequency, usual);
}

double IdentifyPlan::seconds() const {
  return static_cast<double>(square.size()) * leg +
         2 * dwell * static_cast<double>(frequencies.size()) + 4;
}

IdentifyPlan plan_identification(const Rig& rig, const IdentifyRoom& room) {
  const actuation::FieldGeneratorParams& field = rig.params.field;
  const bool rolls = field.kind == actuation::FieldKind::rolling;
  IdentifyPlan plan{.speed = room.speed, .frequency = field.frequency};
  if (rolls) plan.length_per_turn = field.length_per_turn;
  if (!(room.speed > 0))
    throw InputError("the swarm's usual speed is 0: nothing can be identified");
  const double margin = 0.5 * room.radius;
  const auto needed = [&](double leg) {
    return reach_of_side * room.speed * leg + room.radius + margin;
  };
  plan.leg = std::clamp(square_share * room.seconds / static_cast<double>(square.size()), min_leg,
                        max_leg);
  while (plan.leg > min_leg && needed(plan.leg) > room.free)
    plan.leg = std::max(min_leg, 0.95 * plan.leg);
  plan.room = needed(plan.leg);
  if (plan.room > room.free)
    throw InputError(
        fmt::format("no room: the swarm needs {:.0f} µm to walls and to the picture's edge on all "
                    "sides, it has "
                    "{:.0f} µm; move it, or drive it slower ({})",
                    plan.room, room.free, input_name("speed")));
  plan.reach = plan.room - room.radius - margin;
  plan.max_frequency = room.max_frequency.value_or(largest_frequency(rig));
  if (room.max_frequency &&
      (*room.max_frequency > rate_limit(rig.params) || !makes_field(rig, *room.max_frequency)))
    throw InputError(
        fmt::format("{}: {:.6g} Hz are not possible: drive_rate_hz allows {:.6g} Hz, the coils "
                    "{:.6g} Hz",
                    input_name("max_frequency"), *room.max_frequency, rate_limit(rig.params),
                    largest_frequency(rig)));
  const double usual = rolls ? room.speed / field.length_per_turn : plan.frequency;
  plan.frequencies = sweep_of(usual, std::max(usual, plan.max_frequency));
  const double left = room.seconds - static_cast<double>(square.size()) * plan.leg;
  plan.dwell =
      std::clamp(left / 2 / static_cast<double>(plan.frequencies.size()), min_dwell, max_dwell);
  const double fastest = rolls ? field.length_per_turn * plan.frequencies.back() : room.speed;
  plan.dwell = std::max(min_dwell, std::min(plan.dwell, 0.8 * plan.reach / fastest));
  return plan;
}

std::optional<IdentifyStep> IdentifyProgramme::next(double t, const std::optional<Vec2>& seen) {
  now_ = t;
  if (!seen) return hold();
  if (!started_) {
    started_ = true;
    middle_ = *seen;
    began_ = since_ = t;
  }
  return drive(t, *seen);
}

double IdentifyProgramme::progress() const {
  return started_ ? std::min(1.0, (now_ - began_) / plan_.seconds()) : 0;
}

IdentifyStep IdentifyProgramme::hold() const {
  return {.command = {0, 0}, .frequency = plan_.frequency};
}

void IdentifyProgramme::begin(Part part, double t) {
  part_ = part;
  since_ = t;
  measured_at_.reset();
}

bool IdentifyProgramme::is_far(Vec2 seen) const { return distance(seen, middle_) > plan_.reach; }

IdentifyStep IdentifyProgramme::go_back(double t, Vec2 seen) {
  const Vec2 way = middle_ - seen;
  const bool there = norm(way) < 0.1 * plan_.side();
  if (there || t - since_ > longest_way_back) {
    begin(after_, t);
    return hold();
  }
  return {.command = {heading_along(way), plan_.speed}, .frequency = plan_.frequency};
}

std::optional<IdentifyStep> IdentifyProgramme::drive(double t, Vec2 seen) {
  if (part_ == Part::back) return go_back(t, seen);
  if (part_ == Part::rest) return std::nullopt;
  if (part_ == Part::square) return drive_square(t, seen);
  return sweep(t, seen);
}

IdentifyStep IdentifyProgramme::drive_square(double t, Vec2 seen) {
  const bool far = is_far(seen);
  if (far || t - since_ >= plan_.leg) {
    since_ = t;
    ++leg_;
  }
  const bool is_done = leg_ == static_cast<int>(square.size());
  if (far || is_done) {
    after_ = !is_done ? Part::square : plan_.frequencies.empty() ? Part::rest : Part::sweep;
    begin(Part::back, t);
    return go_back(t, seen);
  }
  return {.command = {wrap(radians(square[static_cast<std::size_t>(leg_)])), plan_.speed},
          .frequency = plan_.frequency};
}

/// Command of the level: two sides of a square, the other two at the next level.
IdentifyStep IdentifyProgramme::sweep_step() const {
  const double f = plan_.frequencies[level_];
  const double heading = wrap(pi / 2 * direction_);
  if (plan_.length_per_turn > 0)
    return {.command = {heading, plan_.length_per_turn * f},
            .frequency = sweep_limit(plan_.frequency, plan_.max_frequency),
            .is_sweep = true};
  return {.command = {heading, plan_.speed}, .frequency = f, .is_sweep = true};
}

IdentifyStep IdentifyProgramme::sweep(double t, Vec2 seen) {
  const IdentifyStep step = sweep_step();
  if (!measured_at_ && t - since_ >= settling) {
    measured_at_ = t;
    measured_from_ = seen;
  }
  if (t - since_ < plan_.dwell && !is_far(seen)) return step;
  end_direction(t, seen);
  if (part_ == Part::back) return go_back(t, seen);
  return sweep_step();
}

void IdentifyProgramme::end_direction(double t, Vec2 seen) {
  if (measured_at_) {
    moved_ += distance(seen, measured_from_);
    commanded_ += sweep_step().command.speed * (t - *measured_at_);
  }
  begin(Part::sweep, t);
  const bool behind = falls_behind();
  direction_ = (direction_ + 1) % 4;
  if (direction_ % 2 != 0 && !behind) {
    if (is_far(seen)) after_ = Part::sweep, begin(Part::back, t);
    return;
  }
  best_ = std::max(best_, commanded_ > 0 ? moved_ / commanded_ : 0);
  moved_ = commanded_ = 0;
  const bool ends = behind || ++level_ == plan_.frequencies.size();
  const bool off = is_far(seen) || distance(seen, middle_) > 1.5 * plan_.speed * plan_.dwell;
  after_ = ends ? Part::rest : Part::sweep;
  if (ends || off) begin(Part::back, t);
}

/// Whether the swarm is slower than at the levels before, as far as a few sightings show.
bool IdentifyProgramme::falls_behind() const {
  constexpr double share = 0.6;  // less than followed_share, for the noise
  return moved_ < share * best_ * commanded_;
}

}  // namespace microswarm::rig
