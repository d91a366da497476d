// SPDX-License-Identifier: Apache-2.0
#include "microswarm/experiment/record/record.hpp"

#include <algorithm>

#include "microswarm/core/maths/hash.hpp"
#include "microswarm/core/version.hpp"
#include "microswarm/experiment/scenario/scene.hpp"
#include "microswarm/io/columns.hpp"
#include "microswarm/io/tables.hpp"

namespace microswarm {

namespace {

/// Hashes numbers in their stored types, so equal hashes mean bit-identical records.
struct TableHasher {
  Hash& hash;

  void table(const std::string&, const ListRef<const void*>& list) const {
    rows(list, columns_of(list.row_type()));
  }
  void parts(const std::string&, const ListRef<const void*>& outer, const Field& field) const {
    const auto columns = columns_of(*field.type->parts[0]);
    for (std::size_t i = 0; i < outer.size(); ++i) rows(outer.part(i, field), columns);
  }
  void rows(const ListRef<const void*>& list, const std::vector<Column>& columns) const {
    hash.value(static_cast<std::uint64_t>(list.size()));
    for (const Column& column : columns)
      for (std::size_t i = 0; i < list.size(); ++i)
        column.kind == ColumnKind::word ? hash.text(column.word(list.row(i)))
                                        : hash.value(column.number(list.row(i)));
  }
};

/// Hashes integers as integers.
void hash_metrics(Hash& hash, const Metrics& metrics) {
  for (const Column& column : columns_of<Metrics>()) {
    const double value = column.number(&metrics);
    column.kind == ColumnKind::real ? hash.value(value) : hash.value(static_cast<int>(value));
  }
}

}  // namespace

template const Type& type_of<Record>();

std::string Record::hash() const {
  Hash hash;
  hash.text(to_string(result.status));
  hash_metrics(hash, result.metrics);
  visit_tables(type_of<Record>(), static_cast<const void*>(this), TableHasher{hash});
  for (const Change& change : changes) hash.value(change.frame), hash.text(change.setting);
  return hash.hex();
}

Recorder::Recorder(Scene scene, std::uint32_t trial, std::string rig) {
  record_.version = version;
  record_.scene = std::move(scene);
  record_.trial = trial;
  record_.rig = std::move(rig);
}

void Recorder::on_tick(const Tick& tick) {
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
  if (tick.robots) keep_robots(frame.t, *tick.robots);
  record_.events.insert(record_.events.end(), tick.events.begin(), tick.events.end());
}

void Recorder::keep_robots(double t, std::span<const Vec2> robots) {
  constexpr std::size_t max_moments = 128;
  last_robots_ = {t, {robots.begin(), robots.end()}};
  if (robot_frames_++ % robot_period_ != 0) return;
  std::vector<RobotMoment>& kept = record_.robots;
  if (kept.size() == max_moments) {
    for (std::size_t i = 1; 2 * i < kept.size(); ++i) kept[i] = std::move(kept[2 * i]);
    kept.resize(max_moments / 2);
    robot_period_ *= 2;
  }
  kept.push_back(last_robots_);
}

void Recorder::on_end(const RunResult& result) {
  keep(result);
  if (!record_.robots.empty() && record_.robots.back().t < last_robots_.t)
    record_.robots.push_back(std::move(last_robots_));
}

}  // namespace microswarm
