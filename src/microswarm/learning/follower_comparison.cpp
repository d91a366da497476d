// SPDX-License-Identifier: Apache-2.0
#include "microswarm/learning/follower_comparison.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <mutex>

#include "microswarm/core/execution/parallel.hpp"
#include "microswarm/core/maths/angles.hpp"
#include "microswarm/experiment/plant/plant.hpp"
#include "microswarm/experiment/scenario/scene.hpp"
#include "microswarm/experiment/session/session.hpp"
#include "microswarm/learning/follower_expert.hpp"
#include "microswarm/navigation/make.hpp"

namespace microswarm::learning {
namespace {

constexpr std::array<double, 8> compared_lookaheads{0.15, 0.2, 0.25, 0.3,
                                                    0.4,  0.5, 0.7,  1.0};  // [s]
constexpr std::uint32_t tuning_tasks = 60;
constexpr std::uint32_t first_tuning_task = 1U << 30;

/// Drives with the expert alone.
class ExpertNavigator : public Navigator {
 public:
  ExpertNavigator(const FollowerTask& task, const Plant& plant)
      : plant_(plant),
        expert_(std::get<RibbonParams>(task.scenario.swarm), task.path,
                std::get<RibbonParams>(task.scenario.swarm).max_speed) {}

  Command step(const Observation& seen, const Stop&) override {
    const Command command = expert_.command(plant_.ground_truth()->swarm.pose, seen.now);
    expert_.note(seen.now, command);
    return command;
  }
  NavigatorView view() const override {
    return {.planned = false, .state = NavigatorState::follow};
  }

 private:
  const Plant& plant_;
  FollowerExpert expert_;
};

/// Measures the true distance from the path at every tick.
class Gauge : public experiment::RunListener {
 public:
  explicit Gauge(const std::vector<Vec2>& path) : path_(path) {}

  void on_tick(const experiment::Tick& tick) override {
    if (tick.end) return;
    const experiment::Frame& frame = tick.frame;
    position_ = navigation::nearest_position(path_, frame.pose.position, position_);
    const double off = distance(frame.pose.position, navigation::point_ahead(path_, position_, 0));
    sum_ += off * off;
    trace.push_back(off);
    max_off_ = std::max(max_off_, off);
    ++ticks_;
    fallbacks_ += frame.state == NavigatorState::fallback;
    if (frame.command.speed <= 0) return;
    if (driven_) turning_ += turn_between(frame.command.heading, heading_);
    heading_ = frame.command.heading;
    driven_ = true;
  }

  std::vector<double> trace;

  FollowedPath path(const experiment::RunResult& result, double speed) const {
    const double ticks = std::max(1, ticks_);
    return {.arrived = result.status == Status::solved,
            .time = result.metrics.time,
            .fair_time = navigation::remaining(path_, {}) / speed,
            .rms_off = std::sqrt(sum_ / ticks),
            .max_off = max_off_,
            .field_turning = turning_ / std::max(1e-9, result.metrics.time),
            .fallback_share = fallbacks_ / ticks};
  }

 private:
  const std::vector<Vec2>& path_;
  navigation::PathPosition position_;
  double sum_ = 0, max_off_ = 0, turning_ = 0, heading_ = 0;
  int ticks_ = 0, fallbacks_ = 0;
  bool driven_ = false;
};

/// A follower in the comparison.
struct Method {
  const char* name;
  navigation::FollowerParams follower;
  double lookahead = 0;  ///< [s]
  bool expert = false;
};

FollowedPath follow(const FollowerTask& task, const Method& method, const Stop& stop,
                    std::vector<double>* trace = nullptr) {
  const experiment::Scenario scenario = with_follower(task, method.follower, method.lookahead);
  const auto plant =
      std::make_shared<experiment::KinematicPlant>(scenario, task.world, task.number);
  experiment::SessionParts parts{.trial = task.number, .plant = plant};
  if (method.expert) parts.navigator = std::make_shared<ExpertNavigator>(task, *plant);
  Gauge gauge(task.path);
  experiment::RunListener* const listeners[] = {&gauge};
  const experiment::RunResult result =
      experiment::simulate(scenario, task.world, std::move(parts), listeners, stop);
  if (trace) *trace = std::move(gauge.trace);
  return gauge.path(result, std::get<RibbonParams>(scenario.swarm).max_speed);
}

/// The four followers, with tuned pure pursuits.
std::array<Method, 4> methods(const ComparisonOptions& options, const Stop& stop) {
  const navigation::FollowerParams plain;
  const navigation::FollowerParams against_flow{.correct_flow = true};
  const navigation::FollowerParams learned{.kind = navigation::FollowerKind::learned,
                                           .loaded = options.model};
  const double lookahead = tune_lookahead(options, plain, stop).best();
  const double in_flow = tune_lookahead(options, against_flow, stop).best();
  return {{{"pure pursuit", plain, lookahead},
           {"pure pursuit against the flow", against_flow, in_flow},
           {"learned", learned, in_flow},
           {"expert", plain, in_flow, true}}};
}

}  // namespace

FollowerTask unseen_task(const ComparisonOptions& options, std::uint32_t number) {
  FollowerTaskParams params = options.params;
  params.start_spread = 0;
  return follower_task(params, options.seed, number);
}

double LookaheadTuning::best() const {
  const auto least = std::min_element(rms_off.begin(), rms_off.end());
  return lookahead[static_cast<std::size_t>(least - rms_off.begin())];
}

LookaheadTuning tune_lookahead(const ComparisonOptions& options,
                               const navigation::FollowerParams& follower, const Stop& stop) {
  LookaheadTuning tuning;
  std::vector<std::array<double, compared_lookaheads.size()>> off(tuning_tasks);
  for_each_index(tuning_tasks, options.jobs, [&](std::size_t i) {
    const auto task = unseen_task(options, first_tuning_task + static_cast<std::uint32_t>(i));
    for (std::size_t k = 0; k < compared_lookaheads.size() && !stop(); ++k)
      off[i][k] = follow(task, {"", follower, compared_lookaheads[k]}, stop).rms_off;
  });
  for (std::size_t k = 0; k < compared_lookaheads.size(); ++k) {
    double sum = 0;
    for (const auto& of_task : off) sum += of_task[k];
    tuning.lookahead.push_back(compared_lookaheads[k]);
    tuning.rms_off.push_back(sum / tuning_tasks);
  }
  return tuning;
}

std::vector<FollowerOutcome> compare_followers(const ComparisonOptions& options, const Stop& stop) {
  const auto compared = methods(options, stop);
  const auto tasks = static_cast<std::size_t>(options.tasks);
  std::vector<FollowerOutcome> outcomes;
  outcomes.reserve(compared.size());
  for (const Method& method : compared)
    outcomes.push_back({method.name, std::vector<FollowedPath>(tasks)});
  std::size_t done = 0;
  std::mutex telling;
  for_each_index(tasks, options.jobs, [&](std::size_t i) {
    if (stop()) return;
    const auto task = unseen_task(options, first_unseen_task + static_cast<std::uint32_t>(i));
    for (std::size_t m = 0; m < compared.size(); ++m)
      outcomes[m].paths[i] = follow(task, compared[m], stop);
    const std::lock_guard lock(telling);
    if (options.progress) options.progress(static_cast<double>(++done) / options.tasks);
  });
  return outcomes;
}

std::vector<FollowerTrace> follow_one(const ComparisonOptions& options, std::uint32_t number) {
  const FollowerTask task = unseen_task(options, number);
  std::vector<FollowerTrace> traces;
  for (const Method& method : methods(options, {})) {
    traces.push_back({method.name, {}});
    follow(task, method, {}, &traces.back().off);
  }
  return traces;
}

}  // namespace microswarm::learning
