// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <atomic>
#include <cstddef>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/maths/hash.hpp"
#include "microswarm/core/text/text.hpp"
#include "microswarm/experiment/plant/plant.hpp"
#include "microswarm/experiment/record/played_navigator.hpp"
#include "microswarm/experiment/record/record.hpp"
#include "microswarm/experiment/run/metrics_listener.hpp"
#include "microswarm/experiment/run/open_run.hpp"
#include "microswarm/experiment/scenario/scene.hpp"
#include "microswarm/io/columns.hpp"
#include "microswarm/io/tables.hpp"

namespace microswarm {

namespace {

bool same_bits(double a, double b) {
  Hash first, second;
  first.value(a), second.value(b);
  return first.digest() == second.digest();
}

std::string shown(const Column& column, const void* row) {
  return column.kind == ColumnKind::word ? std::string(column.word(row))
                                         : number_text(column.number(row));
}

/// The first row and quantity in which two lists differ; empty if they are equal.
std::string difference_of(const std::string& row_name, const ListRef<const void*>& stored,
                          const ListRef<const void*>& now) {
  const std::vector<Column> columns = columns_of(stored.row_type());
  const bool timed = columns.front().key == "t_s";
  for (std::size_t i = 0; i < std::min(stored.size(), now.size()); ++i) {
    for (const Column& column : columns) {
      const bool same = column.kind == ColumnKind::word
                            ? column.word(stored.row(i)) == column.word(now.row(i))
                            : same_bits(column.number(stored.row(i)), column.number(now.row(i)));
      if (same) continue;
      const std::string when = timed ? " (t = " + columns.front().text(stored.row(i)) + " s)" : "";
      return row_name + " " + std::to_string(i) + when + ": " + column.key + " is " +
             shown(column, stored.row(i)) + " in the record, " + shown(column, now.row(i)) +
             " in the replay";
    }
  }
  if (stored.size() == now.size()) return {};
  return row_name + "s: " + std::to_string(stored.size()) + " in the record, " +
         std::to_string(now.size()) + " in the replay";
}

/// Compares the tables of both records.
struct Comparison {
  const Record& record;
  const Record& now;
  std::string difference;

  void table(const std::string& group, const ListRef<const void*>& stored) {
    if (difference.empty()) difference = difference_of(row_name(group), stored, of_now(stored));
  }
  void parts(const std::string& group, const ListRef<const void*>& stored, const Field& field) {
    const ListRef<const void*> again = of_now(stored);
    for (std::size_t i = 0; i < stored.size() && difference.empty(); ++i)
      difference = difference_of(group.substr(1) + " " + std::to_string(i) + ", row",
                                 stored.part(i, field), again.part(i, field));
  }

 private:
  static std::string row_name(const std::string& group) {
    return group.substr(1, group.size() - 2);  // "/frames" → "frame"
  }
  /// The list of the other record at the same member offset.
  ListRef<const void*> of_now(const ListRef<const void*>& stored) const {
    const auto offset =
        static_cast<const std::byte*>(stored.value) - reinterpret_cast<const std::byte*>(&record);
    return {stored.type, reinterpret_cast<const std::byte*>(&now) + offset};
  }
};

/// Frames after which a replay is stopped, including the end frame; 0: it ends by itself. A hold at
/// the goal may have been stopped.
std::size_t frames_to_repeat(const Record& record) {
  const bool may_be_stopped =
      record.result.status == Status::stopped ||
      (record.result.status == Status::solved && record.scene.scenario.hold_at_goal > 0);
  return may_be_stopped ? record.frames.size() : 0;
}

/// Stops a replay at the end of a stopped record, or when the caller stops.
class Ending : public RunListener {
 public:
  Ending(const Record& record, const Stop& stop) : stop_(stop), left_(frames_to_repeat(record)) {
    over_ = left_ == 1;
  }
  void on_tick(const Tick&) override {
    stopped_ = stopped_ || stop_();
    if (left_ > 1) --left_;
    over_ = left_ == 1 || stopped_;
  }
  const std::atomic<bool>& over() const { return over_; }
  bool stopped() const { return stopped_; }

 private:
  Stop stop_;
  std::size_t left_;  // remaining frames including the end frame; 0: no limit
  bool stopped_ = false;
  std::atomic<bool> over_;
};

/// Applies the record's changes at their frames, and repeats its manual operation.
class Changes : public RunListener {
 public:
  Changes(const Record& record, OpenRun& open) : record_(record), open_(open) {
    apply();
    operate();
  }
  void on_tick(const Tick&) override {
    ++frame_;
    apply();
    operate();
  }
  /// Reason why a change failed; empty if none did.
  const std::string& refused() const { return refused_; }

 private:
  void apply() {
    const std::vector<Change>& changes = record_.changes;
    for (; next_ < changes.size() && changes[next_].frame == frame_; ++next_) {
      const Setting setting = parse_setting(changes[next_].setting, "set");
      const Issues issues = open_.change(setting.key, setting.value);
      if (!issues.empty() && refused_.empty())
        refused_ = "change '" + changes[next_].setting + "' before frame " +
                   std::to_string(frame_) + " is refused: " + issues.begin()->text;
    }
  }

  void operate() {
    if (frame_ >= record_.frames.size()) return;
    const Frame& frame = record_.frames[frame_];
    Operation& operation = open_.operation();
    operation.pause(frame.state == NavigatorState::paused);
    operation.manual(frame.state == NavigatorState::manual);
    operation.steer(frame.command);
  }

  const Record& record_;
  OpenRun& open_;
  std::uint64_t frame_ = 0;
  std::size_t next_ = 0;
  std::string refused_;
};

/// Repeats the ticks of a run that had not ended when it was recorded.
void repeat(const Record& record, OpenRun& open, std::span<RunListener* const> listeners,
            Recorder& recorder) {
  MetricsListener metrics(record.scene.scenario);
  for (std::size_t i = 0; i < record.frames.size(); ++i) {
    const Tick* tick = open.step();
    if (!tick) break;
    metrics.on_tick(*tick);
    for (RunListener* listener : listeners) listener->on_tick(*tick);
  }
  recorder.keep(metrics.result());
}

std::string difference_of(const Metrics& stored, const Metrics& now) {
  for (const Column& column : columns_of<Metrics>()) {
    const double was = column.number(&stored), is = column.number(&now);
    if (!same_bits(was, is))
      return "metrics: " + column.key + " is " + number_text(was) + " in the record, " +
             number_text(is) + " in the replay";
  }
  return {};
}

}  // namespace

ReplayResult replay(const Record& record, const Stop& stop) {
  if (!record.rig.empty())
    throw InputError("a run on a rig (" + record.rig + ") cannot be repeated");
  Recorder recorder(record.scene, record.trial);
  Ending ending(record, stop);
  const Scenario& scenario = record.scene.scenario;
  const World world = build_world(record.scene);
  OpenRun open(scenario, world, make_kinematic_plant(scenario, world, record.trial), record.trial,
               record.navigator.empty() ? nullptr : std::make_unique<PlayedNavigator>(record));
  Changes changes(record, open);
  RunListener* const listeners[] = {&recorder, &ending, &changes};
  if (record.result.status == Status::running)
    repeat(record, open, listeners, recorder);
  else
    open.finish(listeners, Stop(&ending.over()));
  const Record now = recorder.take();
  if (ending.stopped()) return {.identical = false, .stopped = true, .difference = {}};

  Comparison comparison{record, now, changes.refused()};
  visit_tables(type_of<Record>(), static_cast<const void*>(&record), comparison);
  std::string difference = std::move(comparison.difference);
  if (difference.empty() && record.result.status != now.result.status)
    difference = "status is " + std::string(to_string(record.result.status)) + " in the record, " +
                 std::string(to_string(now.result.status)) + " in the replay";
  if (difference.empty()) difference = difference_of(record.result.metrics, now.result.metrics);
  if (difference.empty() && !record.stated_hash.empty() && record.stated_hash != record.hash())
    difference = "record_hash is " + record.stated_hash + " in the record, " + record.hash() +
                 " by what it holds";
  const bool identical = difference.empty();
  return {.identical = identical, .stopped = false, .difference = std::move(difference)};
}

}  // namespace microswarm
