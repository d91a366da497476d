// SPDX-License-Identifier: Apache-2.0
#include <atomic>

#include "microswarm/core/error.hpp"
#include "microswarm/core/hash.hpp"
#include "microswarm/core/text.hpp"
#include "microswarm/experiment/record/record.hpp"
#include "microswarm/experiment/record/record_layout.hpp"
#include "microswarm/experiment/run/open_run.hpp"
#include "microswarm/experiment/scenario/scene.hpp"

namespace microswarm {

namespace {

bool same_bits(double a, double b) {
  Hash first, second;
  first.value(a), second.value(b);
  return first.digest() == second.digest();
}

/// The first row and quantity in which two tables differ; empty when they do not.
template <class Rows>
std::string difference_of(const std::string& row_name, const Rows& stored, const Rows& now) {
  using Row = typename Rows::value_type;
  const std::vector<Column<Row>> columns = columns_of(static_cast<const Row*>(nullptr));
  for (std::size_t i = 0; i < std::min(stored.size(), now.size()); ++i) {
    const auto parted = [&](const Column<Row>& column, const std::string& was,
                            const std::string& is) {
      const bool timed = columns.front().key == "t_s";
      const std::string when =
          timed ? " (t = " + number_text(columns.front().number(stored[i])) + " s)" : "";
      return row_name + " " + std::to_string(i) + when + ": " + column.key + " is " + was +
             " in the record, " + is + " in the replay";
    };
    for (const Column<Row>& column : columns) {
      if (column.kind == ColumnKind::word) {
        const std::string was = column.word(stored[i]), is = column.word(now[i]);
        if (was != is) return parted(column, was, is);
      } else {
        const double was = column.number(stored[i]), is = column.number(now[i]);
        if (!same_bits(was, is)) return parted(column, number_text(was), number_text(is));
      }
    }
  }
  if (stored.size() == now.size()) return {};
  return row_name + "s: " + std::to_string(stored.size()) + " in the record, " +
         std::to_string(now.size()) + " in the replay";
}

/// Goes through the tables of both records side by side.
struct Comparison {
  const Record& now;
  std::string difference;

  template <class Rows>
  void table(const std::string& group, const Rows& stored) {
    if (difference.empty())
      difference =
          difference_of(row_name(group), stored, table_of(static_cast<const Rows*>(nullptr)));
  }
  template <class Rows, class Part>
  void parts(const std::string& group, const Rows& stored, Part part) {
    const Rows& again = table_of(static_cast<const Rows*>(nullptr));
    for (std::size_t i = 0; i < stored.size() && difference.empty(); ++i)
      difference = difference_of(group.substr(1) + " " + std::to_string(i) + ", row",
                                 part(stored[i]), part(again[i]));
  }

 private:
  static std::string row_name(const std::string& group) {
    return group.substr(1, group.size() - 2);  // "/frames" → "frame"
  }
  const std::vector<Frame>& table_of(const std::vector<Frame>*) const { return now.frames; }
  const std::vector<PathChange>& table_of(const std::vector<PathChange>*) const {
    return now.paths;
  }
  const std::vector<PlanEvent>& table_of(const std::vector<PlanEvent>*) const { return now.plans; }
  const std::vector<RobotMoment>& table_of(const std::vector<RobotMoment>*) const {
    return now.robots;
  }
  const std::vector<RunEvent>& table_of(const std::vector<RunEvent>*) const { return now.events; }
};

/// Ends a replay where the record was stopped, and when the caller stops.
class Ending : public RunListener {
 public:
  Ending(const Record& record, const Stop& stop)
      : stop_(stop), left_(record.result.status == Status::stopped ? record.frames.size() : 0) {
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
  std::size_t left_;  // frames to come, the one for the end included; 0 without a limit
  bool stopped_ = false;
  std::atomic<bool> over_;
};

/// Changes an experiment when the record did.
class Changes : public RunListener {
 public:
  Changes(const std::vector<Change>& changes, OpenRun& open) : changes_(changes), open_(open) {
    apply();
  }
  void on_tick(const Tick&) override {
    ++frame_;
    apply();
  }
  /// Why one could not be made; empty while all could.
  const std::string& refused() const { return refused_; }

 private:
  void apply() {
    for (; next_ < changes_.size() && changes_[next_].frame == frame_; ++next_) {
      const Issues issues = open_.change(changes_[next_].setting);
      if (!issues.empty() && refused_.empty())
        refused_ = "change '" + changes_[next_].setting + "' before frame " +
                   std::to_string(frame_) + " is refused: " + issues.begin()->text;
    }
  }

  const std::vector<Change>& changes_;
  OpenRun& open_;
  std::uint64_t frame_ = 0;
  std::size_t next_ = 0;
  std::string refused_;
};

using Numbers = std::vector<std::pair<std::string, double>>;

struct NumbersOf {
  Numbers& numbers;
  std::string prefix;

  template <class T>
  void operator()(const T& value, const FieldInfo& info) {
    if constexpr (HasFields<T>)
      T::fields(value, NumbersOf{numbers, prefix + std::string(info.name) + "."});
    else
      numbers.emplace_back(prefix + std::string(info.name), static_cast<double>(value));
  }
};

std::string difference_of(const Metrics& stored, const Metrics& now) {
  Numbers was, is;
  Metrics::fields(stored, NumbersOf{was, ""});
  Metrics::fields(now, NumbersOf{is, ""});
  for (std::size_t i = 0; i < was.size(); ++i)
    if (!same_bits(was[i].second, is[i].second))
      return "metrics: " + was[i].first + " is " + number_text(was[i].second) + " in the record, " +
             number_text(is[i].second) + " in the replay";
  return {};
}

}  // namespace

ReplayResult replay(const Record& record, const Stop& stop) {
  if (!record.rig.empty())
    throw InputError("a run on a rig (" + record.rig + ") cannot be repeated");
  Recorder recorder(record.scene, record.trial);
  Ending ending(record, stop);
  OpenRun open(record.scene.scenario, build_world(record.scene), record.trial);
  Changes changes(record.changes, open);
  RunListener* const listeners[] = {&recorder, &ending, &changes};
  finish(open, listeners, Stop(&ending.over()));
  const Record now = recorder.take();
  if (ending.stopped()) return {.identical = false, .stopped = true, .difference = {}};

  Comparison comparison{now, changes.refused()};
  visit_tables(record, comparison);
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
