// SPDX-License-Identifier: Apache-2.0
#include "microswarm/experiment/run/episode.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

#include "microswarm/core/maths/infinity.hpp"
#include "microswarm/experiment/results/metrics.hpp"

namespace microswarm::experiment {
namespace {

using Clock = std::chrono::steady_clock;

/// Cuts a trajectory at time t.
void cut(std::vector<PoseStamped>& trajectory, double t) {
  PoseStamped end = moment_on(trajectory, t);
  end.t = t;
  std::erase_if(trajectory, [t](const PoseStamped& pose) { return pose.t >= t && pose.t > 0; });
  if (t > 0) trajectory.push_back(end);
}

}  // namespace

Episode::Episode(const Scenario& scenario, Plant& plant, Navigator& navigator, Operation* operation)
    : scenario_(scenario),
      plant_(plant),
      navigator_(&navigator),
      operation_(operation),
      obstacles_(scenario.sensing.obstacle_memory),
      state_(scenario, plant),
      clock_(scenario),
      goal_(scenario),
      hold_(scenario) {
  goal_.take_goal(pose().position);
  const auto ground_truth = plant.ground_truth();
  if (ground_truth && !scenario.robots) contacts_.emplace(*ground_truth->world);
}

void Episode::change(const std::string& setting, Navigator& navigator) {
  coming_changes_.push_back(setting);
  prepared_ = prepared_ && navigator_ == &navigator;
  if (navigator_ != &navigator) shown_ = nullptr;
  navigator_ = &navigator;
  if (setting.starts_with("goal_um")) clock_.leave();
  goal_.take_goal(pose().position);
  if (contacts_) contacts_->take_obstacles();
}

const Tick* Episode::step(const Stop& stop) {
  if (tick_.end) return nullptr;
  tick_ = {};
  data_.events.clear();
  data_.trajectory.clear();
  data_.changes = std::exchange(coming_changes_, {});
  tick_.changes = data_.changes;
  if (operation_) mode_ = operation_->mode();
  tick_.holding = clock_.at_goal();
  if (!ending_) take_time();
  if (!ending_ && (stop() || (operation_ && operation_->is_ended()))) ending_ = stopped();
  if (ending_ || !advance(stop)) end();
  if (shown_)
    tick_.diagnostics = Lazy<Diagnostics>([by = shown_] {  // without a swarm nothing is decided
      return by->view().state == NavigatorState::blind ? Diagnostics() : by->diagnostics();
    });
  tick_.events = data_.events;
  tick_.trajectory = data_.trajectory;
  if (contacts_) tick_.contacts = &*contacts_;
  return &tick_;
}

/// Ends the episode at its time limit; pauses do not count.
void Episode::take_time() {
  if (mode_ == OperatingMode::paused || !clock_.count()) return;
  ending_ = clock_.at_goal() ? Status::solved : hold_.holds() ? Status::held : Status::time_limit;
}

/// False if the episode ends before the tick starts.
bool Episode::advance(const Stop& stop) {
  const Observation seen = obstacles_.complete(plant_.observe());
  state_.take_robots(seen, goal_);
  state_.take(seen, goal_);
  if (state_.take_sight(seen)) {
    note(EventKind::robots_unseen);
    data_.events.back().body = static_cast<std::uint32_t>(state_.unseen());
  }
  if (!plant_.fault().empty()) {
    fault_ = plant_.fault();
    ending_ = Status::fault;
  } else if (is_autonomous() && !clock_.at_goal() && goal_.reached(state_.now().goal_distance) &&
             state_.unseen() == 0) {
    ending_ = arrive();
  }
  if (ending_) return false;
  if (!std::exchange(prepared_, true)) navigator_->prepare(*seen.world, stop);
  if (stop()) {
    ending_ = stopped();
    return false;
  }

  const Clock::time_point begin = Clock::now();
  const Command command = decide(seen, stop);
  const double took = std::chrono::duration<double>(Clock::now() - begin).count();
  // Discard an interrupted step: the record must be reproducible without the interruption.
  if (stop()) {
    shown_ = nullptr;
    tick_.view = {};
    ending_ = stopped();
    return false;
  }

  tick_.step_time = took;
  tick_.frame.command = command;
  tick_.frame.target = tick_.view.local_target;
  tick_.frame.state = tick_.view.state;
  tick_.frame.planned = tick_.view.planned;
  fill(seen);
  if (is_autonomous() && !clock_.at_goal()) {
    if (const auto change = hold_.take(command)) note(*change);
    if (hold_.at_limit()) {
      ending_ = Status::held;
      return true;
    }
  }
  plant_.apply(command, scenario_.tick);
  if (contacts_) ending_ = follow(*plant_.ground_truth());
  return true;
}

Command Episode::decide(const Observation& seen, const Stop& stop) {
  shown_ = mode_ == OperatingMode::manual ? nullptr : navigator_;
  if (is_autonomous()) {
    const Command command = navigator_->step(seen, stop);
    tick_.view = navigator_->view();
    return command;
  }
  Command command{pose().heading, 0};
  if (mode_ == OperatingMode::manual) {
    command = operation_->by_hand().step(seen, stop);
    tick_.view = operation_->by_hand().view();
  } else {
    tick_.view = navigator_->view();
    tick_.view.planned = false;
    tick_.view.state = NavigatorState::paused;
  }
  navigator_->overruled(seen.now, command);
  return command;
}

/// Detects contact and arrival on the last trajectory, in order of time.
std::optional<Status> Episode::follow(const GroundTruth& ground_truth) {
  const double t0 = state_.now().t;
  std::vector<PoseStamped>& trajectory = data_.trajectory;
  std::vector<RunEvent>& events = data_.events;
  trajectory.assign(ground_truth.trajectory.begin(), ground_truth.trajectory.end());
  const bool arrives = is_autonomous() && !clock_.at_goal();
  const double arrival = arrives ? goal_.first_arrival(trajectory).value_or(infinity) : infinity;
  const bool is_there = arrival < infinity;
  if (is_there && scenario_.hold_at_goal <= 0) cut(trajectory, arrival);
  const ContactMonitor before = *contacts_;
  const std::vector<RunEvent> touches = contacts_->follow(t0, trajectory);
  const bool ends = !touches.empty() && scenario_.stop_at_contact;
  if (ends) {
    cut(trajectory, touches.front().t - t0);
    *contacts_ = before;  // motion after the contact does not count for its clearances
    contacts_->follow(t0, trajectory);
  }
  touched_ = touched_ || !touches.empty();
  events.insert(events.end(), touches.begin(), ends ? touches.begin() + 1 : touches.end());
  if (!trajectory.empty()) {
    const PoseStamped& last = trajectory.back();
    state_.take({t0 + last.t, last.pose, last.radius,
                 ends ? touches.front().speed : ground_truth.speed,
                 goal_.left(last.pose.position, {})});
  }
  if (!is_there || (ends && touches.front().t <= t0 + arrival))
    return ends ? std::optional(Status::collided) : std::nullopt;
  const std::optional<Status> ending = arrive();
  if (!ending) {  // within the tick, which continues
    events.back().t = t0 + arrival;
    events.back().position = moment_on(trajectory, arrival).pose.position;
    std::ranges::stable_sort(events, {}, &RunEvent::t);
  }
  return ends ? Status::collided : ending;
}

/// The swarm is at the goal: ends the episode, unless the swarm is to be held there.
std::optional<Status> Episode::arrive() {
  note(EventKind::goal_reached);
  return clock_.arrive() ? std::nullopt : std::optional(Status::solved);
}

/// Fills the last tick with the final state.
void Episode::end() {
  const Observation seen = plant_.observe();
  state_.take_robots(seen, goal_);
  const bool ends_between_ticks =
      *ending_ == Status::collided || (*ending_ == Status::solved && !clock_.at_goal());
  if (!ends_between_ticks) state_.take(seen, goal_);
  tick_.frame.state = NavigatorState::end;
  fill(seen);
  tick_.end = touched_ && *ending_ != Status::stopped ? Status::collided : *ending_;
  tick_.fault = fault_;
}

/// Fills the tick with the current state of the world.
void Episode::fill(const Observation& seen) {
  const SwarmState::Values& now = state_.now();
  const Snapshot& world = data_.world.emplace(state_.world(seen));
  tick_.world = &world;
  if (goal_.has_robots()) {
    const std::span<const Vec2> robots = state_.robots(seen);
    data_.robots.assign(robots.begin(), robots.end());
    tick_.robots = data_.robots;
  }
  Frame& frame = tick_.frame;
  frame.t = now.t;
  frame.pose = now.pose;
  frame.radius = now.radius;
  frame.speed = now.speed;
  frame.seen = seen.seen;
  if (seen.swarm) frame.observed = seen.swarm->pose;
  frame.goal_distance = now.goal_distance;
  const bool one_is_there = !goal_.has_robots() && state_.was_seen();
  frame.wall_clearance = one_is_there ? world.map().clearance(frame.pose.position) : infinity;
  frame.obstacle_clearance =
      one_is_there ? world.moving().clearance(frame.pose.position, infinity) : infinity;
  const double range =
      scenario_.detection_range.value_or(navigation::required_detection_range(scenario_.navigator));
  tick_.detects = !goal_.has_robots() && frame.obstacle_clearance - frame.radius < range;
  if (tick_.detects)
    frame.avoidance_cost = avoidance_cost(
        tick_.view.phased_goal.value_or(*scenario_.goal) - frame.pose.position, frame.goal_distance,
        frame.pose.heading, frame.speed > 0, goal_.start_distance());
}

void Episode::note(EventKind kind) {
  const SwarmState::Values& now = state_.now();
  data_.events.push_back(
      {.t = now.t, .kind = kind, .position = now.pose.position, .speed = now.speed});
}

}  // namespace microswarm::experiment
