// SPDX-License-Identifier: Apache-2.0
#include "microswarm/experiment/run/run.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <memory>

#include "microswarm/core/angles.hpp"
#include "microswarm/experiment/run/plant.hpp"
#include "microswarm/experiment/run/robot_plant.hpp"
#include "microswarm/experiment/run/robot_task.hpp"
#include "microswarm/experiment/run/watch.hpp"
#include "microswarm/experiment/scenario/scene.hpp"
#include "microswarm/navigation/make.hpp"
#include "microswarm/navigation/prediction/obstacle_memory.hpp"

namespace microswarm {

namespace {

using Clock = std::chrono::steady_clock;

/// The swarm at the present: as it is when the plant knows, else as it was last seen.
struct Present {
  double t = 0;
  Pose2 pose;
  double radius = 0;
  double speed = 0;
  double goal_distance = std::numeric_limits<double>::infinity();
};

/// One run between its first and last tick.
class Run {
 public:
  Run(const Scenario& scenario, Plant& plant, Navigator& navigator,
      std::span<RunListener* const> listeners)
      : scenario_(scenario),
        plant_(plant),
        navigator_(navigator),
        listeners_(listeners),
        obstacles_(scenario.sensing.obstacle_memory) {
    if (scenario.start) present_.pose = *scenario.start;
    detection_range_ = scenario.detection_range.value_or(detection_range_of(scenario.navigator));
    if (scenario.goal) start_distance_ = distance(present_.pose.position, *scenario.goal);
    const auto truth = plant.truth();
    if (truth && !scenario.robots) watch_.emplace(*truth->world);
  }

  RunResult to_the_end(const Stop& stop) {
    const double ticks = std::ceil(scenario_.time_limit / scenario_.tick - 1e-9);
    std::optional<Status> status;
    for (double i = 0; i < ticks && !status; ++i) status = stop() ? Status::stopped : tick(stop);
    if (!status) status = hold_time_ > 0 ? Status::held : Status::time_limit;
    return finish(*status);
  }

 private:
  std::optional<Status> tick(const Stop& stop) {
    const Observation seen = obstacles_.complete(plant_.observe());
    was_seen_ = was_seen_ || seen.swarm || plant_.truth();
    if (scenario_.robots && !task_) begin_with_robots(seen);
    move_to(present(seen));
    if (!plant_.fault().empty()) {
      result_.state = plant_.fault();
      return Status::fault;
    }
    if (present_.goal_distance <= scenario_.goal_tolerance) return arrived();
    if (result_.timing.steps.empty()) navigator_.prepare(*seen.world);

    const Clock::time_point begin = Clock::now();
    const Command command = navigator_.step(seen, stop);
    const double took = std::chrono::duration<double>(Clock::now() - begin).count();
    // A step that was told to stop half-way is none: the record must repeat without the telling.
    if (stop()) return Status::stopped;

    note_step(seen, command, took);
    const double held = note_hold(command);
    if (held > 0 && held >= scenario_.hold_limit - 1e-9) return Status::held;
    plant_.apply(command, scenario_.tick);
    return watch_ ? follow(*plant_.truth()) : std::nullopt;
  }

  void begin_with_robots(const Observation& seen) {
    task_.emplace(scenario_, seen.world->map());
    const auto truth = plant_.truth();
    if (truth || seen.swarm) present_.pose = truth ? truth->swarm.pose : seen.swarm->pose;
  }

  Present present(const Observation& seen) {
    if (const auto truth = plant_.truth())
      return {truth->now, truth->swarm.pose, scenario_.robots ? 0 : truth->swarm.radius,
              truth->speed, left(truth->swarm.pose.position, truth->robots)};
    if (!seen.swarm)
      return {seen.now, present_.pose, present_.radius, present_.speed, present_.goal_distance};
    const double passed = seen.now - present_.t;
    const double way = distance(present_.pose.position, seen.swarm->pose.position);
    return {seen.now, seen.swarm->pose, scenario_.robots ? 0 : seen.swarm->radius,
            passed > 0 ? way / passed : 0, left(seen.swarm->pose.position, seen.robots)};
  }

  /// How far it is to the end of the task [µm].
  double left(Vec2 centre, std::span<const Vec2> robots) {
    return task_ ? task_->left(robots) : distance(centre, *scenario_.goal);
  }

  void move_to(const Present& next) {
    result_.metrics.length += distance(present_.pose.position, next.pose.position);
    result_.metrics.turning += turn_between(present_.pose.heading, next.pose.heading);
    present_ = next;
  }

  /// The same along all of a way that began at t0.
  void move_along(std::span<const TimedPose> way, double t0, double speed) {
    for (const TimedPose& p : way)
      move_to({t0 + p.t, p.pose, p.radius, speed, left(p.pose.position, {})});
  }

  void note_step(const Observation& seen, const Command& command, double took) {
    const NavigatorView view = navigator_.view();
    result_.timing.steps.push_back(took);
    if (view.planned) result_.timing.planning.push_back(took);
    result_.metrics.planning_events += view.planned;
    Frame frame;
    frame.command = command;
    frame.target = view.local_target;
    frame.state = view.state;
    result_.state = view.state;
    frame.planned = view.planned;
    tell(frame, view, seen);
    note_avoidance(frame);
  }

  /// Each tick counts as it begins.
  void note_avoidance(const Frame& frame) {
    if (!is_detected(frame)) return;
    cost_sum_ += frame.avoidance_cost;
    gap_sum_ += frame.obstacle_clearance - frame.radius;
    ++detected_ticks_;
  }

  bool is_detected(const Frame& frame) const {
    return !task_ && frame.obstacle_clearance - frame.radius < detection_range_;
  }

  /// How long the swarm has been told to hold by now.
  double note_hold(const Command& command) {
    const bool holds = command.speed <= 0;
    if (holds != (hold_time_ > 0)) tell(holds ? EventKind::hold_begins : EventKind::hold_ends);
    hold_time_ = holds ? hold_time_ + scenario_.tick : 0;
    if (holds) result_.metrics.hold_time += scenario_.tick;
    return hold_time_;
  }

  /// Contact and arrival on the way just made, in the order in which they came.
  std::optional<Status> follow(const Truth& truth) {
    const double t0 = present_.t;
    std::vector<TimedPose> way(truth.swept.begin(), truth.swept.end());
    const auto arrival = first_arrival(way, *scenario_.goal, scenario_.goal_tolerance);
    if (arrival) cut(way, *arrival);
    const Watch before = *watch_;
    const std::vector<RunEvent> touches = watch_->follow(t0, way);
    if (!touches.empty() && scenario_.stop_at_contact) {
      cut(way, touches.front().t - t0);
      *watch_ = before;  // what would have come after the touch is none of its clearances
      watch_->follow(t0, way);
    }
    for (const RunEvent& touch : touches) {
      ++result_.metrics.contacts;
      result_.metrics.avoidable_contacts += touch.speed > 0;
      for (RunListener* listener : listeners_) listener->on_event(touch);
      if (!scenario_.stop_at_contact) continue;
      move_along(way, t0, touch.speed);
      return Status::collided;
    }
    move_along(way, t0, truth.speed);
    if (!arrival) return std::nullopt;
    return arrived();
  }

  Status arrived() {
    tell(EventKind::goal_reached);
    return Status::solved;
  }

  static void cut(std::vector<TimedPose>& way, double t) {
    TimedPose end = moment_on(way, t);
    end.t = t;
    std::erase_if(way, [t](const TimedPose& pose) { return pose.t >= t && pose.t > 0; });
    if (t > 0) way.push_back(end);
  }

  RunResult finish(Status status) {
    const Observation seen = plant_.observe();
    if (scenario_.robots && !task_) begin_with_robots(seen);
    if (status != Status::solved && status != Status::collided) move_to(present(seen));
    Frame frame;
    frame.state = "end";
    tell(frame, {}, seen);
    const bool touched = status != Status::stopped && result_.metrics.contacts > 0;
    result_.status = touched ? Status::collided : status;
    Metrics& metrics = result_.metrics;
    metrics.time = present_.t;
    metrics.goal_distance = present_.goal_distance;
    if (detected_ticks_ > 0) {
      const double ticks = static_cast<double>(result_.timing.steps.size());
      metrics.avoidance.mean_cost = cost_sum_ / ticks;
      metrics.avoidance.time = detected_ticks_ * scenario_.tick;
      metrics.avoidance.mean_gap = gap_sum_ / detected_ticks_;
    }
    if (watch_) {
      metrics.walls = watch_->walls();
      metrics.obstacles = watch_->obstacles();
      metrics.avoidance.least_gap = watch_->least_gap();
    }
    for (RunListener* listener : listeners_) listener->on_end(result_);
    return std::move(result_);
  }

  /// Fills in what the world is like at the present, and tells everybody.
  void tell(Frame& frame, const NavigatorView& view, const Observation& seen) {
    const auto truth = plant_.truth();
    const Snapshot world = truth ? truth->world->at(present_.t) : *seen.world;
    frame.t = present_.t;
    frame.pose = present_.pose;
    frame.radius = present_.radius;
    frame.speed = present_.speed;
    frame.seen = seen.seen;
    if (seen.swarm) frame.observed = seen.swarm->pose;
    frame.goal_distance = present_.goal_distance;
    constexpr double none = std::numeric_limits<double>::infinity();
    const bool one_is_there = !task_ && was_seen_;
    frame.wall_clearance = one_is_there ? world.map().clearance(frame.pose.position) : none;
    frame.obstacle_clearance =
        one_is_there ? world.moving().clearance(frame.pose.position, none) : none;
    if (is_detected(frame))
      frame.avoidance_cost =
          avoidance_cost(view.phased_goal.value_or(*scenario_.goal) - frame.pose.position,
                         frame.goal_distance, frame.pose.heading, frame.speed > 0, start_distance_);
    if (!watch_) {
      Metrics& metrics = result_.metrics;
      if (frame.wall_clearance < metrics.walls.clearance)
        metrics.walls = {frame.wall_clearance, frame.t};
      if (frame.obstacle_clearance < metrics.obstacles.clearance)
        metrics.obstacles = {frame.obstacle_clearance, frame.t};
      metrics.avoidance.least_gap =
          std::min(metrics.avoidance.least_gap, frame.obstacle_clearance - frame.radius);
    }
    for (RunListener* listener : listeners_) {
      listener->on_frame(frame, view, world);
      if (task_) listener->on_robots(frame.t, truth ? truth->robots : seen.robots);
    }
  }

  void tell(EventKind kind) {
    const RunEvent event{
        .t = present_.t, .kind = kind, .position = present_.pose.position, .speed = present_.speed};
    for (RunListener* listener : listeners_) listener->on_event(event);
  }

  const Scenario& scenario_;
  Plant& plant_;
  Navigator& navigator_;
  std::span<RunListener* const> listeners_;
  ObstacleMemory obstacles_;
  std::optional<Watch> watch_;
  std::optional<RobotTask> task_;  // of robots that are told apart
  Present present_;
  bool was_seen_ = false;  // the swarm, at least once
  double hold_time_ = 0;
  double detection_range_ = 0;  // [µm]
  double start_distance_ = 0;   // from the goal [µm]
  double cost_sum_ = 0;
  double gap_sum_ = 0;  // [µm]
  int detected_ticks_ = 0;
  RunResult result_;
};

}  // namespace

RunResult run(const Scenario& scenario, Plant& plant, Navigator& navigator,
              std::span<RunListener* const> listeners, const Stop& stop) {
  return Run(scenario, plant, navigator, listeners).to_the_end(stop);
}

std::unique_ptr<Plant> make_kinematic_plant(const Scenario& scenario, const World& world,
                                            std::uint32_t trial) {
  if (scenario.robots) return std::make_unique<RobotPlant>(scenario, world, trial);
  return std::make_unique<KinematicPlant>(scenario, world, trial);
}

RunResult simulate(const Scenario& scenario, const World& world, std::uint32_t trial,
                   std::span<RunListener* const> listeners, const Stop& stop) {
  const std::unique_ptr<Plant> plant = make_kinematic_plant(scenario, world, trial);
  const auto navigator = make_navigator(scenario.navigator, task_of(scenario),
                                        Rng(scenario.seed, Purpose::planner, trial));
  return run(scenario, *plant, *navigator, listeners, stop);
}

}  // namespace microswarm
