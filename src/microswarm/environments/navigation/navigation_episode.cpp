// SPDX-License-Identifier: Apache-2.0
#include "microswarm/environments/navigation/navigation_episode.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/maths/maths.hpp"
#include "microswarm/experiment/plant/make_plant.hpp"
#include "microswarm/geometry/uniform_in.hpp"
#include "microswarm/swarm/body/swarm_params.hpp"

namespace microswarm::environments {
namespace {

/// A random place that keeps `clearance` from the walls. Throws InputError if none is found.
Vec2 random_place(const Map& map, double clearance, Rng& rng) {
  constexpr int tries = 100'000;
  for (int i = 0; i < tries; ++i) {
    const Vec2 position = uniform_in(map.bounds(), rng);
    if (map.is_free(position, clearance)) return position;
  }
  throw InputError("the map has no free place for a random start or goal");
}

/// Free distance from `from` in a direction to bodies and walls [µm], at most `range`, within 0.1
/// µm.
double free_distance(const Snapshot& world, Vec2 from, Vec2 direction, double range) {
  constexpr double near = 0.1;
  constexpr int steps = 64;
  double reached = 0;
  for (int i = 0; i < steps && reached < range; ++i) {
    const double room = world.clearance(from + reached * direction);
    if (room < near) return reached;
    reached += room;
  }
  return std::min(reached, range);
}

/// Shortens a vector of the length d to d / (d + reach).
void squash(std::span<float, 2> v, double reach) {
  const double by = 1 / (norm({v[0], v[1]}) + reach);
  for (float& one : v) one = static_cast<float>(one * by);
}
void squash(float& length, double reach) {
  length = static_cast<float>(length / (double{length} + reach));
}

}  // namespace

/// Navigator that returns the agent's action.
class NavigationEpisode::Agent final : public Navigator {
 public:
  Command command;

  Command step(const Observation&, const Stop&) override { return command; }
  NavigatorView view() const override {
    return {.state = command.speed > 0 ? NavigatorState::follow : NavigatorState::hold,
            .local_target = {},
            .path = {}};
  }
};

NavigationTask::NavigationTask(experiment::Experiment experiment, const NavigationRules& rules)
    : experiment_(std::move(experiment)), rules_(rules), max_speed_(0) {
  experiment::Scenario& scenario = experiment_.scene.scenario;
  if (scenario.robots || !scenario.start || !scenario.goal)
    throw InputError("an environment of navigation needs a scenario with one swarm");
  scenario.hold_at_goal = 0;
  max_speed_ = swarm_limits(scenario.swarm).max_speed;
}

std::size_t NavigationTask::observation_size() const {
  return own_numbers + static_cast<std::size_t>(rules_.rays) +
         obstacle_numbers * static_cast<std::size_t>(rules_.obstacles);
}

std::size_t NavigationTask::episode_bytes() const {
  const double ticks = std::min(scenario().time_limit / scenario().tick, 1e5);
  return 20'000 + 1000 * scenario().obstacles.size() +
         sizeof(NavigationAction) * static_cast<std::size_t>(ticks);
}

NavigationEpisode::NavigationEpisode(const NavigationTask& task, std::uint64_t seed,
                                     std::span<float> observation)
    : task_(task), seed_(seed), observation_(observation) {
  reset(seed);
}
NavigationEpisode::NavigationEpisode(const NavigationEpisode& other, std::span<float> observation)
    : task_(other.task_), seed_(other.seed_), observation_(observation) {
  restore(other.state());
}
NavigationEpisode::~NavigationEpisode() = default;
NavigationEpisode::NavigationEpisode(NavigationEpisode&&) noexcept = default;

void NavigationEpisode::reset(std::uint64_t seed) {
  seed_ = seed;
  trial_ = 0;
  reset();
}

NavigationState NavigationEpisode::state() const {
  return {.seed = seed_, .trial = trial_ - 1, .actions = actions_};
}

EnvironmentStep NavigationEpisode::restore(const NavigationState& state) {
  for (const NavigationAction& action : state.actions)
    if (!std::isfinite(action.heading) || !(action.speed >= 0 && action.speed <= task_.max_speed()))
      throw InputError("a state of an environment has an input that is no heading and speed");
  seed_ = state.seed;
  trial_ = state.trial;
  reset();
  EnvironmentStep made;
  for (const NavigationAction& action : state.actions) made = step(action);
  return made;
}

void NavigationEpisode::reset() {
  actions_.clear();
  experiment::Scenario scenario = task_.scenario();
  scenario.seed = seed_;
  const NavigationRules& rules = task_.rules();
  Rng rng(seed_, Purpose::start_goal, trial_);
  const double clearance = 2 * swarm_limits(scenario.swarm).radius;
  const Map& map = *task_.world().map;
  if (rules.random_start)
    scenario.start =
        Pose2{random_place(map, clearance, rng), rng.uniform(-std::numbers::pi, std::numbers::pi)};
  if (rules.random_goal) scenario.goal = random_place(map, clearance, rng);
  agent_ = std::make_shared<Agent>();
  plant_ = experiment::make_kinematic_plant(scenario, task_.world(), trial_);
  goal_ = *scenario.goal;
  const double goal_tolerance = scenario.goal_tolerance;
  experiment::Experiment opened;
  opened.scene.scenario = std::move(scenario);
  opened.world = task_.world();
  session_ = std::make_unique<experiment::Session>(
      std::move(opened), experiment::SessionParts{.trial = trial_,
                                                  .plant = plant_,
                                                  .navigator = agent_,
                                                  .keep = experiment::Keep::nothing});
  ++trial_;
  status_ = Status::running;
  cut_ = false;
  look(nullptr);
  start_distance_ = std::max(distance_, goal_tolerance);
}

EnvironmentStep NavigationEpisode::step(const NavigationAction& action) {
  EnvironmentStep made;
  if (status_ == Status::running) {
    agent_->command = action;
    actions_.push_back(action);
    made = advance();
  }
  made.terminated = status_ != Status::running && !cut_;
  made.truncated = cut_;
  made.success = status_ == Status::solved;
  if (made.has_ended()) made.reason = to_string(status_);
  return made;
}

/// The next tick; sets the status and returns the reward.
EnvironmentStep NavigationEpisode::advance() {
  EnvironmentStep made;
  const double before = distance_;
  const experiment::Scenario& scenario = session_->scenario();
  const experiment::Tick* tick = session_->step();
  if (tick && tick->end) {  // the hold limit or the number of steps is reached
    status_ = *tick->end;
    cut_ = true;
    return made;
  }
  const NavigationRules& rules = task_.rules();
  for (const experiment::RunEvent& event : tick->events) {
    if (event.kind == experiment::EventKind::goal_reached) {
      status_ = Status::solved;
      made.reward += rules.arrival_reward;
    } else if (event.kind == experiment::EventKind::contact_wall ||
               event.kind == experiment::EventKind::contact_obstacle) {
      if (scenario.stop_at_contact) status_ = Status::collided;
      made.reward -= rules.contact_penalty;
    }
  }
  look(tick);
  made.reward += (before - distance_) / start_distance_;
  made.reward -= rules.time_penalty * scenario.tick / scenario.time_limit;
  const bool was_last = rules.max_episode_steps > 0 &&
                        actions_.size() >= static_cast<std::size_t>(rules.max_episode_steps);
  if (status_ == Status::running &&
      (was_last || time_ >= scenario.time_limit - 1e-9 * scenario.tick)) {
    status_ = Status::time_limit;
    cut_ = true;
  }
  return made;
}

Snapshot NavigationEpisode::world() const { return plant_->ground_truth()->world->at(time_); }

/// Takes the state at the end of a tick, or the first one.
void NavigationEpisode::look(const experiment::Tick* tick) {
  const GroundTruth truth = *plant_->ground_truth();
  pose_ = truth.swarm.pose;
  radius_ = truth.swarm.radius;
  if (tick && !tick->trajectory.empty()) {  // it may end with a contact or the arrival
    pose_ = tick->trajectory.back().pose;
    radius_ = tick->trajectory.back().radius;
  }
  time_ = truth.now;
  distance_ = distance(pose_.position, goal_);
  const Vec2 to_goal = goal_ - pose_.position;
  const Vec2 ahead = unit_vector(pose_.heading);
  const std::array<double, NavigationTask::own_numbers> own{to_goal.x, to_goal.y,   ahead.x,
                                                            ahead.y,   truth.speed, radius_};
  std::ranges::transform(own, observation_.begin(), [](double v) { return static_cast<float>(v); });
  const Snapshot world = truth.world->at(truth.now);
  const auto rays = static_cast<std::size_t>(task_.rules().rays);
  see_rays(world, observation_.subspan(NavigationTask::own_numbers, rays));
  see_obstacles(world, observation_.subspan(NavigationTask::own_numbers + rays));
  if (task_.rules().scaled) scale_observation();
}

void NavigationEpisode::scale_observation() const {
  const double reach = task_.rules().ray_range;
  const double max_speed = task_.max_speed();
  squash(observation_.first<2>(), reach);
  float& speed = observation_[4];
  speed = static_cast<float>(std::min(speed / max_speed, 1.0));
  squash(observation_[5], reach);
  std::span<float> rest = observation_.subspan(NavigationTask::own_numbers);
  const auto rays = static_cast<std::size_t>(task_.rules().rays);
  for (float& ray : rest.first(rays)) ray = static_cast<float>(ray / reach);
  for (rest = rest.subspan(rays); !rest.empty();
       rest = rest.subspan(NavigationTask::obstacle_numbers)) {
    squash(rest.first<2>(), reach);
    squash(rest[2], reach);
    squash(rest.subspan<3, 2>(), max_speed);
  }
}

void NavigationEpisode::see_rays(const Snapshot& world, std::span<float> out) const {
  for (std::size_t k = 0; k < out.size(); ++k) {
    const double angle =
        2 * std::numbers::pi * static_cast<double>(k) / static_cast<double>(out.size());
    out[k] = static_cast<float>(
        free_distance(world, pose_.position, unit_vector(angle), task_.rules().ray_range));
  }
}

void NavigationEpisode::see_obstacles(const Snapshot& world, std::span<float> out) const {
  std::ranges::fill(out, 0.0f);
  const double past = std::max(0.0, time_ - task_.scenario().tick);
  const Snapshot before = plant_->ground_truth()->world->at(past);
  const auto& bodies = world.moving().bodies();
  struct Seen {
    double gap;
    std::size_t index;
  };
  std::vector<Seen> seen;
  seen.reserve(bodies.size());
  for (std::size_t i = 0; i < bodies.size(); ++i)
    seen.push_back({distance(pose_.position, bodies[i]), i});
  const std::size_t shown = std::min(seen.size(), out.size() / NavigationTask::obstacle_numbers);
  std::ranges::partial_sort(seen, seen.begin() + static_cast<std::ptrdiff_t>(shown), {},
                            &Seen::gap);
  for (std::size_t k = 0; k < shown; ++k) {
    const Disc now = enclosing_disc(bodies[seen[k].index]);
    Vec2 velocity{};
    if (time_ > past && before.moving().bodies().size() == bodies.size())
      velocity = (now.centre - enclosing_disc(before.moving().bodies()[seen[k].index]).centre) /
                 (time_ - past);
    const Vec2 from = now.centre - pose_.position;
    float* to = &out[k * NavigationTask::obstacle_numbers];
    for (const double v : {from.x, from.y, now.radius, velocity.x, velocity.y})
      *to++ = static_cast<float>(v);
  }
}

}  // namespace microswarm::environments
