// SPDX-License-Identifier: Apache-2.0
#include "microswarm/experiment/record/record.hpp"

#include <algorithm>

#include "microswarm/core/hash.hpp"
#include "microswarm/core/version.hpp"
#include "microswarm/experiment/record/record_layout.hpp"
#include "microswarm/experiment/scenario/scene.hpp"

namespace microswarm {

namespace {

struct TableHasher {
  Hash& hash;

  template <class Rows>
  void table(std::string_view, const Rows& rows) {
    using Row = typename Rows::value_type;
    hash.value(static_cast<std::uint64_t>(rows.size()));
    for (const Column<Row>& column : columns_of(static_cast<const Row*>(nullptr)))
      for (const Row& row : rows)
        column.kind == ColumnKind::word ? hash.text(column.word(row))
                                        : hash.value(column.number(row));
  }
  template <class Rows, class Part>
  void parts(std::string_view group, const Rows& rows, Part part) {
    for (const auto& row : rows) table(group, part(row));
  }
};

struct FieldHasher {
  Hash& hash;

  template <class T>
  void operator()(const T& value, const FieldInfo&) {
    if constexpr (HasFields<T>)
      T::fields(value, *this);
    else
      hash.value(value);
  }
};

}  // namespace

std::string Record::hash() const {
  Hash hash;
  hash.text(to_string(result.status));
  FieldHasher fields{hash};
  Metrics::fields(result.metrics, fields);
  visit_tables(*this, TableHasher{hash});
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
  if (tick.robots) keep_robots(frame.t, *tick.robots);
  record_.events.insert(record_.events.end(), tick.events.begin(), tick.events.end());
}

void Recorder::keep_robots(double t, std::span<const Vec2> robots) {
  constexpr std::size_t most_moments = 128;
  last_robots_ = {t, {robots.begin(), robots.end()}};
  if (robot_frames_++ % robot_period_ != 0) return;
  std::vector<RobotMoment>& kept = record_.robots;
  if (kept.size() == most_moments) {
    for (std::size_t i = 1; 2 * i < kept.size(); ++i) kept[i] = std::move(kept[2 * i]);
    kept.resize(most_moments / 2);
    robot_period_ *= 2;
  }
  kept.push_back(last_robots_);
}

void Recorder::on_end(const RunResult& result) {
  record_.result = result;
  if (!record_.robots.empty() && record_.robots.back().t < last_robots_.t)
    record_.robots.push_back(std::move(last_robots_));
}

}  // namespace microswarm
