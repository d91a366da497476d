// SPDX-License-Identifier: Apache-2.0
#include "microswarm/experiment/session/playback.hpp"

#include <algorithm>

#include "microswarm/config/yaml.hpp"

namespace microswarm::experiment {
namespace {

/// The newest row at time t; null before the first.
template <class Row>
const Row* newest(const std::vector<Row>& rows, double t) {
  const auto after = std::ranges::upper_bound(rows, t, {}, &Row::t);
  return after == rows.begin() ? nullptr : &after[-1];
}

}  // namespace

Scenario scenario_at(const Record& record, double t) {
  Scenario scenario = record.scene.scenario;
  for (const Change& change : record.changes)
    if (change.t <= t) set_value(scenario, change.setting, "set");
  return scenario;
}

Playback::Playback(Record record)
    : record_(std::move(record)),
      scenario_(record_.scene.scenario),
      world_(build_world(record_.scene)) {}

std::optional<std::size_t> Playback::seek(std::size_t frame) {
  next_ = record_.frames.empty() ? 0 : std::min(frame, record_.frames.size() - 1);
  scenario_ = record_.scene.scenario;
  changed_ = 0;
  if (next_ > 0) apply_changes(next_ - 1);
  world_.obstacles = scenario_.obstacles;
  return next_;
}

void Playback::apply_changes(std::size_t frame) {
  changes_.clear();
  for (; changed_ < record_.changes.size() && record_.changes[changed_].frame <= frame;
       ++changed_) {
    set_value(scenario_, record_.changes[changed_].setting, "set");
    changes_.push_back(record_.changes[changed_].setting);
  }
  if (!changes_.empty()) world_.obstacles = scenario_.obstacles;
}

Issues Playback::set(const std::string& key, const std::string&) {
  Issues issues;
  issues.add(key, "a record cannot be changed");
  return issues;
}

/// Time of the last decision up to a frame: its own, or for the end the one before.
double Playback::decided_at(std::size_t frame) const {
  const bool is_end = frame > 0 && record_.frames[frame].state == NavigatorState::end;
  return record_.frames[is_end ? frame - 1 : frame].t;
}

const Tick* Playback::step(const Stop&) {
  if (next_ >= record_.frames.size()) return nullptr;
  apply_changes(next_);
  const Frame& frame = record_.frames[next_];
  const bool is_last = ++next_ == record_.frames.size();
  snapshot_ = world_.at(frame.t);
  tick_ = {};
  tick_.frame = frame;
  tick_.changes = changes_;
  tick_.world = &*snapshot_;
  tick_.view.planned = frame.planned;
  tick_.view.state = frame.state;
  tick_.view.local_target = frame.target;
  if (const auto* path = newest(record_.paths, frame.t)) tick_.view.path = path->path;
  if (const auto* event = newest(record_.plans, frame.t)) tick_.view.plan = &event->plan;
  if (const auto* moment = newest(record_.robots, frame.t)) tick_.robots = moment->positions;
  tick_.diagnostics =
      Lazy<Diagnostics>([this, t = decided_at(next_ - 1)] { return record_.diagnostics.at(t); });
  const auto& events = record_.events;
  const auto begin = std::ranges::lower_bound(events, frame.t, {}, &RunEvent::t);
  const auto end =
      is_last ? events.end()
              : std::ranges::lower_bound(events, record_.frames[next_].t, {}, &RunEvent::t);
  tick_.events = {begin, end};
  if (is_last && record_.result.status != Status::running) tick_.end = record_.result.status;
  return &tick_;
}

}  // namespace microswarm::experiment
