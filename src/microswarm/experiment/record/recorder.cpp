// SPDX-License-Identifier: Apache-2.0
#include "microswarm/experiment/record/recorder.hpp"

#include <algorithm>

#include "microswarm/core/version.hpp"

namespace microswarm::experiment {

Recorder::Recorder(Scene scene, std::uint32_t trial, std::string rig)
    : record_{.version = std::string(version),
              .scene = std::move(scene),
              .trial = trial,
              .rig = std::move(rig)},
      metrics_(record_.scene.scenario, record_.result) {}

void Recorder::on_tick(const Tick& tick) {
  metrics_.on_tick(tick);
  const Frame& frame = tick.frame;
  const NavigatorView& view = tick.view;
  for (const std::string& setting : tick.changes)
    record_.changes.push_back({frame.t, record_.frames.size(), setting});
  record_.frames.push_back(frame);
  if (frame.planned && view.plan) record_.plans.push_back({frame.t, *view.plan});
  const bool same = record_.paths.empty()
                        ? view.path.empty()
                        : std::ranges::equal(record_.paths.back().path, view.path);
  if (!same) record_.paths.push_back({frame.t, {view.path.begin(), view.path.end()}});
  if (!record_.navigator.empty()) {
    std::vector<PhasedGoal>& kept = record_.phased_goals;
    if (view.phased_goal != (kept.empty() ? std::nullopt : kept.back().point))
      kept.push_back({frame.t, view.phased_goal});
  }
  if (tick.robots) keep_robots(tick);
  if (record_.scene.scenario.record.diagnostics && !tick.end)
    record_.diagnostics.add(frame.t, tick.diagnostics.value());
  record_.events.insert(record_.events.end(), tick.events.begin(), tick.events.end());
}

void Recorder::keep_robots(const Tick& tick) {
  constexpr std::size_t max_moments = 128;
  std::vector<RobotMoment>& kept = record_.robots;
  const bool is_due = robot_frames_++ % robot_period_ == 0;  // the first one is
  if (!is_due && !(tick.end && kept.back().t < tick.frame.t)) return;
  if (is_due && kept.size() == max_moments) {
    for (std::size_t i = 1; 2 * i < kept.size(); ++i) kept[i] = std::move(kept[2 * i]);
    kept.resize(max_moments / 2);
    robot_period_ *= 2;
  }
  kept.push_back({tick.frame.t, {tick.robots->begin(), tick.robots->end()}});
}

}  // namespace microswarm::experiment
