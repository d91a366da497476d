// SPDX-License-Identifier: Apache-2.0
#include "microswarm/experiment/run/episode.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

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
      goal_(scenario),
      hold_(scenario) {
  if (scenario.start) present_.pose = *scenario.start;
  goal_.take_goal(present_.pose.position);
  const auto ground_truth = plant.ground_truth();
  if (ground_truth && !scenario.robots) contacts_.emplace(*ground_truth->world);
}

void Episode::change(const std::string& setting, Navigator& navigator) {
  coming_changes_.push_back(setting);
  prepared_ = prepared_ && navigator_ == &navigator;
  if (navigator_ != &navigator) shown_ = nullptr;
  navigator_ = &navigator;
  if (setting.starts_with("goal_um")) at_goal_ = false;
  goal_.take_goal(present_.pose.position);
  if (contacts_) contacts_->take_obstacles();
}

const Tick* Episode::step(const Stop& stop) {
  if (tick_.end) return nullptr;
  tick_ = {};
  events_.clear();
  trajectory_.clear();
  changes_ = std::exchange(coming_changes_, {});
  tick_.changes = changes_;
  if (operation_) mode_ = operation_->mode();
  tick_.holding = at_goal_;
  if (!ending_) take_time();
  if (!ending_ && (stop() || (operation_ && operation_->is_ended()))) ending_ = stopped();
  if (ending_ || !advance(stop)) end();
  if (shown_) tick_.diagnostics = Lazy<Diagnostics>([by = shown_] { return by->diagnostics(); });
  tick_.events = events_;
  tick_.trajectory = trajectory_;
  if (contacts_) tick_.contacts = &*contacts_;
  return &tick_;
}

/// Ends the episode at its time limit; pauses do not count.
void Episode::take_time() {
  if (mode_ == OperatingMode::paused) return;
  const auto ticks = [&](double time) { return std::ceil(time / scenario_.tick - 1e-9); };
  if (at_goal_ && held_++ >= ticks(scenario_.hold_at_goal)) ending_ = Status::solved;
  if (!at_goal_ && done_++ >= ticks(scenario_.time_limit))
    ending_ = hold_.holds() ? Status::held : Status::time_limit;
}

/// False if the episode ends before the tick starts.
bool Episode::advance(const Stop& stop) {
  const Observation seen = obstacles_.complete(plant_.observe());
  was_seen_ = was_seen_ || seen.swarm || plant_.ground_truth();
  take_robots(seen);
  present_ = present(seen);
  note_unseen(seen);
  if (!plant_.fault().empty()) {
    fault_ = plant_.fault();
    ending_ = Status::fault;
  } else if (is_autonomous() && !at_goal_ && goal_.reached(present_.goal_distance) &&
             unseen_ == 0) {
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
  if (is_autonomous() && !at_goal_) {
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
  Command command{present_.pose.heading, 0};
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

/// Notes the robots that a rig does not detect; they may be anywhere. A simulation's ground truth
/// has all of them.
void Episode::note_unseen(const Observation& seen) {
  if (plant_.ground_truth() || seen.unseen == unseen_) return;
  unseen_ = seen.unseen;
  note(EventKind::robots_unseen);
  events_.back().body = static_cast<std::uint32_t>(unseen_);
}

void Episode::take_robots(const Observation& seen) {
  if (!goal_.take_robots(seen.world->map())) return;
  const auto ground_truth = plant_.ground_truth();
  if (ground_truth || seen.swarm)
    present_.pose = ground_truth ? ground_truth->swarm.pose : seen.swarm->pose;
}

Episode::Present Episode::present(const Observation& seen) {
  if (const auto ground_truth = plant_.ground_truth())
    return {ground_truth->now, ground_truth->swarm.pose,
            scenario_.robots ? 0 : ground_truth->swarm.radius, ground_truth->speed,
            goal_.left(ground_truth->swarm.pose.position, ground_truth->robots)};
  if (!seen.swarm)
    return {seen.now, present_.pose, present_.radius, present_.speed, present_.goal_distance};
  const double passed = seen.now - present_.t;
  const double moved = distance(present_.pose.position, seen.swarm->pose.position);
  return {seen.now, seen.swarm->pose, scenario_.robots ? 0 : seen.swarm->radius,
          passed > 0 ? moved / passed : 0, goal_.left(seen.swarm->pose.position, seen.robots)};
}

/// Detects contact and arrival on the last trajectory, in order of time.
std::optional<Status> Episode::follow(const GroundTruth& ground_truth) {
  const double t0 = present_.t;
  trajectory_.assign(ground_truth.trajectory.begin(), ground_truth.trajectory.end());
  const bool arrives = is_autonomous() && !at_goal_;
  const double arrival = arrives ? goal_.first_arrival(trajectory_).value_or(infinity) : infinity;
  const bool is_there = arrival < infinity;
  if (is_there && scenario_.hold_at_goal <= 0) cut(trajectory_, arrival);
  const ContactMonitor before = *contacts_;
  const std::vector<RunEvent> touches = contacts_->follow(t0, trajectory_);
  const bool ends = !touches.empty() && scenario_.stop_at_contact;
  if (ends) {
    cut(trajectory_, touches.front().t - t0);
    *contacts_ = before;  // motion after the contact does not count for its clearances
    contacts_->follow(t0, trajectory_);
  }
  touched_ = touched_ || !touches.empty();
  events_.insert(events_.end(), touches.begin(), ends ? touches.begin() + 1 : touches.end());
  if (!trajectory_.empty()) {
    const PoseStamped& last = trajectory_.back();
    present_ = {t0 + last.t, last.pose, last.radius,
                ends ? touches.front().speed : ground_truth.speed,
                goal_.left(last.pose.position, {})};
  }
  if (!is_there || (ends && touches.front().t <= t0 + arrival))
    return ends ? std::optional(Status::collided) : std::nullopt;
  const std::optional<Status> ending = arrive();
  if (!ending) {  // within the tick, which continues
    events_.back().t = t0 + arrival;
    events_.back().position = moment_on(trajectory_, arrival).pose.position;
    std::ranges::stable_sort(events_, {}, &RunEvent::t);
  }
  return ends ? Status::collided : ending;
}

/// The swarm is at the goal: ends the episode, unless the swarm is to be held there.
std::optional<Status> Episode::arrive() {
  note(EventKind::goal_reached);
  if (scenario_.hold_at_goal <= 0) return Status::solved;
  at_goal_ = true;
  held_ = 0;
  return std::nullopt;
}

/// Fills the last tick with the final state.
void Episode::end() {
  const Observation seen = plant_.observe();
  take_robots(seen);
  const bool ends_between_ticks =
      *ending_ == Status::collided || (*ending_ == Status::solved && !at_goal_);
  if (!ends_between_ticks) present_ = present(seen);
  tick_.frame.state = NavigatorState::end;
  fill(seen);
  tick_.end = touched_ && *ending_ != Status::stopped ? Status::collided : *ending_;
  tick_.fault = fault_;
}

/// Fills the tick with the current state of the world.
void Episode::fill(const Observation& seen) {
  const auto ground_truth = plant_.ground_truth();
  world_ = ground_truth ? ground_truth->world->at(present_.t) : *seen.world;
  tick_.world = &*world_;
  if (goal_.has_robots()) {
    const std::span<const Vec2> robots = ground_truth ? ground_truth->robots : seen.robots;
    robots_.assign(robots.begin(), robots.end());
    tick_.robots = robots_;
  }
  Frame& frame = tick_.frame;
  frame.t = present_.t;
  frame.pose = present_.pose;
  frame.radius = present_.radius;
  frame.speed = present_.speed;
  frame.seen = seen.seen;
  if (seen.swarm) frame.observed = seen.swarm->pose;
  frame.goal_distance = present_.goal_distance;
  const bool one_is_there = !goal_.has_robots() && was_seen_;
  frame.wall_clearance = one_is_there ? world_->map().clearance(frame.pose.position) : infinity;
  frame.obstacle_clearance =
      one_is_there ? world_->moving().clearance(frame.pose.position, infinity) : infinity;
  const double range =
      scenario_.detection_range.value_or(navigation::required_detection_range(scenario_.navigator));
  tick_.detects = !goal_.has_robots() && frame.obstacle_clearance - frame.radius < range;
  if (tick_.detects)
    frame.avoidance_cost = avoidance_cost(
        tick_.view.phased_goal.value_or(*scenario_.goal) - frame.pose.position, frame.goal_distance,
        frame.pose.heading, frame.speed > 0, goal_.start_distance());
}

void Episode::note(EventKind kind) {
  events_.push_back(
      {.t = present_.t, .kind = kind, .position = present_.pose.position, .speed = present_.speed});
}

}  // namespace microswarm::experiment
