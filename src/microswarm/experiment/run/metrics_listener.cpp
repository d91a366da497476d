// SPDX-License-Identifier: Apache-2.0
#include "microswarm/experiment/run/metrics_listener.hpp"

#include <algorithm>

#include "microswarm/core/maths/angles.hpp"

namespace microswarm::experiment {

namespace {

/// The event of the arrival in this tick; null for none.
const RunEvent* find_arrival(const Tick& tick) {
  const auto found = std::ranges::find(tick.events, EventKind::goal_reached, &RunEvent::kind);
  return found == tick.events.end() ? nullptr : &*found;
}

}  // namespace

MetricsListener::MetricsListener(const Scenario& scenario, RunResult& result)
    : tick_(scenario.tick), result_(result) {
  if (!scenario.robots) at_ = scenario.start;
  result_ = {.status = Status::running};
}

void MetricsListener::on_tick(const Tick& tick) {
  note_contacts(tick);
  if (tick.holding) return hold(tick);
  is_held_ = false;
  note_distance(tick);
  note_clearances(tick);
  if (tick.end)
    note_end(tick);
  else
    note_step(tick);
  summarise(tick.frame);
  if (const RunEvent* arrival = find_arrival(tick)) result_.metrics.time = arrival->t;
}

/// Stops counting while the swarm is held at the goal: metrics end with the arrival.
void MetricsListener::hold(const Tick& tick) {
  if (!is_held_) result_.metrics.goal_distance = tick.frame.goal_distance;
  is_held_ = true;
  if (tick.end) return note_end(tick);
  result_.state = enum_name(tick.frame.state);
  result_.timing.steps.push_back(tick.step_time);
}

void MetricsListener::note_contacts(const Tick& tick) {
  for (const RunEvent& event : tick.events) {
    const bool touch =
        event.kind == EventKind::contact_wall || event.kind == EventKind::contact_obstacle;
    result_.metrics.contacts += touch;
    result_.metrics.avoidable_contacts += touch && event.speed > 0;
  }
}

void MetricsListener::note_distance(const Tick& tick) {
  move_to(tick.frame.pose);
  const RunEvent* const arrival = tick.end ? nullptr : find_arrival(tick);
  for (const PoseStamped& pose : tick.trajectory)
    if (!arrival || tick.frame.t + pose.t <= arrival->t) move_to(pose.pose);
  if (arrival && at_) move_to({arrival->position, at_->heading});
}

void MetricsListener::move_to(const Pose2& pose) {
  if (at_) {
    result_.metrics.length += distance(at_->position, pose.position);
    result_.metrics.turning += turn_between(at_->heading, pose.heading);
  }
  at_ = pose;
}

/// Counts each tick at its start.
void MetricsListener::note_step(const Tick& tick) {
  Metrics& metrics = result_.metrics;
  result_.state = enum_name(tick.frame.state);
  result_.timing.steps.push_back(tick.step_time);
  if (tick.frame.planned) result_.timing.planning.push_back(tick.step_time);
  metrics.planning_events += tick.frame.planned;
  if (tick.frame.command.speed <= 0) metrics.hold_time += tick_;
  if (!tick.detects) return;
  cost_sum_ += tick.frame.avoidance_cost;
  gap_sum_ += tick.frame.obstacle_clearance - tick.frame.radius;
  ++detected_ticks_;
}

void MetricsListener::note_clearances(const Tick& tick) {
  Metrics& metrics = result_.metrics;
  if (tick.contacts) {
    metrics.walls = tick.contacts->walls();
    metrics.obstacles = tick.contacts->obstacles();
    metrics.avoidance.min_gap = tick.contacts->min_gap();
    return;
  }
  const Frame& frame = tick.frame;
  if (frame.wall_clearance < metrics.walls.clearance)
    metrics.walls = {frame.wall_clearance, frame.t};
  if (frame.obstacle_clearance < metrics.obstacles.clearance)
    metrics.obstacles = {frame.obstacle_clearance, frame.t};
  metrics.avoidance.min_gap =
      std::min(metrics.avoidance.min_gap, frame.obstacle_clearance - frame.radius);
}

void MetricsListener::note_end(const Tick& tick) {
  result_.status = *tick.end;
  if (!tick.fault.empty()) result_.state = tick.fault;
}

void MetricsListener::summarise(const Frame& newest) {
  Metrics& metrics = result_.metrics;
  metrics.time = newest.t;
  metrics.goal_distance = newest.goal_distance;
  if (detected_ticks_ == 0) return;
  metrics.avoidance.mean_cost = cost_sum_ / static_cast<double>(result_.timing.steps.size());
  metrics.avoidance.time = detected_ticks_ * tick_;
  metrics.avoidance.mean_gap = gap_sum_ / detected_ticks_;
}

}  // namespace microswarm::experiment
