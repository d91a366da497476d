// SPDX-License-Identifier: Apache-2.0
#include "microswarm/experiment/session/replay.hpp"

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <memory>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/maths/hash.hpp"
#include "microswarm/core/text/text.hpp"
#include "microswarm/experiment/session/played_navigator.hpp"
#include "microswarm/io/columns.hpp"
#include "microswarm/io/tables.hpp"

namespace microswarm::experiment {

namespace {

bool same_bits(double a, double b) {
  Hash first, second;
  first.value(a), second.value(b);
  return first.digest() == second.digest();
}

std::string shown(const io::Column& column, const void* row) {
  return column.kind == io::ColumnKind::word ? std::string(column.word(row))
                                             : number_text(column.number(row));
}

/// The first row and quantity in which two lists differ; empty if they are equal.
std::string first_difference(const std::string& row_name, const io::ListRef<const void*>& stored,
                             const io::ListRef<const void*>& now) {
  const std::vector<io::Column> columns = io::to_columns(stored.row_type());
  const bool timed = columns.front().key == "t_s";
  for (std::size_t i = 0; i < std::min(stored.size(), now.size()); ++i) {
    for (const io::Column& column : columns) {
      const bool same = column.kind == io::ColumnKind::word
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

/// Compares the tables of two values of one type.
struct Comparison {
  const void* first;
  const void* second;
  std::string difference;

  void table(const std::string& group, const io::ListRef<const void*>& stored) {
    if (difference.empty()) difference = first_difference(row_name(group), stored, of_now(stored));
  }
  void parts(const std::string& group, const io::ListRef<const void*>& stored, const Field& field) {
    const io::ListRef<const void*> again = of_now(stored);
    for (std::size_t i = 0; i < stored.size() && difference.empty(); ++i)
      difference = first_difference(group.substr(1) + " " + std::to_string(i) + ", row",
                                    stored.part(i, field), again.part(i, field));
  }

 private:
  static std::string row_name(const std::string& group) {
    return group.substr(1, group.size() - (group.ends_with('s') ? 2 : 1));  // "/frames" → "frame"
  }
  /// The list of the second value at the same member offset.
  io::ListRef<const void*> of_now(const io::ListRef<const void*>& stored) const {
    const auto offset =
        static_cast<const std::byte*>(stored.value) - static_cast<const std::byte*>(first);
    return {stored.type, static_cast<const std::byte*>(second) + offset};
  }
};

/// Repeats the inputs of a run: its changes, and how it was operated.
class Inputs {
 public:
  Inputs(const Record& record, Session& session) : record_(record), session_(session) {}

  /// Gives what came before a frame.
  void give(std::size_t frame) {
    apply(frame);
    if (frame < record_.frames.size()) operate(record_.frames[frame]);
  }
  /// Reason why a change failed; empty if none did.
  const std::string& refused() const { return refused_; }

 private:
  void apply(std::size_t frame) {
    const std::vector<Change>& changes = record_.changes;
    for (; next_ < changes.size() && changes[next_].frame == frame; ++next_) {
      const Setting setting = parse_setting(changes[next_].setting, "set");
      const Issues issues = session_.set(setting.key, setting.value);
      if (!issues.empty() && refused_.empty())
        refused_ = "change '" + to_string(setting) + "' before frame " + std::to_string(frame) +
                   " is refused: " + issues.begin()->text;
    }
  }

  void operate(const Frame& frame) {
    Operation& operation = *session_.operation();
    operation.pause(frame.state == NavigatorState::paused);
    operation.manual(frame.state == NavigatorState::manual);
    operation.steer(frame.command);
  }

  const Record& record_;
  Session& session_;
  std::size_t next_ = 0;
  std::string refused_;
};

/// Repeats the run as far as it was recorded. False if the caller stopped it.
bool repeat(const Record& record, Session& session, Inputs& inputs, const Stop& stop) {
  const Status status = record.result.status;
  const bool goes_on = status == Status::running;
  // A hold at the goal may have been stopped.
  const bool was_stopped = status == Status::stopped ||
                           (status == Status::solved && record.scene.scenario.hold_at_goal > 0);
  const std::size_t count = record.frames.size();
  const std::atomic<bool> yes = true;
  for (std::size_t frame = 0; !goes_on || frame < count; ++frame) {
    inputs.give(frame);
    const bool ends = was_stopped && frame + 1 == count;
    const bool made = session.step(ends ? Stop(&yes) : stop) != nullptr;
    if (stop()) return false;
    if (!made) break;
  }
  return true;
}

std::string first_difference(const Metrics& stored, const Metrics& now) {
  for (const io::Column& column : io::to_columns<Metrics>()) {
    const double was = column.number(&stored), is = column.number(&now);
    if (!same_bits(was, is))
      return "metrics: " + column.key + " is " + number_text(was) + " in the record, " +
             number_text(is) + " in the replay";
  }
  return {};
}

void require_simulated(const Record& record) {
  if (!record.rig.empty())
    throw InputError("a run on a rig (" + record.rig + ") cannot be repeated");
}

/// The first difference of the replay; empty if there is none.
std::string first_difference(const Record& record, const Record& now, const std::string& refused) {
  Comparison comparison{&record, &now, refused};
  io::visit_tables(type_of<Record>(), static_cast<const void*>(&record), comparison);
  if (!record.diagnostics.empty()) {
    comparison.first = &record.diagnostics;
    comparison.second = &now.diagnostics;
    io::visit_tables(type_of<DiagnosticsLog>(), comparison.first, comparison, "/diagnostics");
  }
  if (!comparison.difference.empty()) return std::move(comparison.difference);
  if (record.result.status != now.result.status)
    return "status is " + std::string(to_string(record.result.status)) + " in the record, " +
           std::string(to_string(now.result.status)) + " in the replay";
  std::string difference = first_difference(record.result.metrics, now.result.metrics);
  if (difference.empty() && !record.stated_hash.empty() && record.stated_hash != record.hash())
    difference = "record_hash is " + record.stated_hash + " in the record, " + record.hash() +
                 " by what it holds";
  return difference;
}

}  // namespace

ReplayResult replay(const Record& record, const Stop& stop) {
  require_simulated(record);
  SessionParts parts{.trial = record.trial};
  if (!record.navigator.empty()) parts.navigator = std::make_shared<PlayedNavigator>(record);
  Session session({record.scene, build_world(record.scene), {}}, std::move(parts));
  Inputs inputs(record, session);
  if (!repeat(record, session, inputs, stop))
    return {.identical = false, .stopped = true, .difference = {}};

  std::string difference = first_difference(record, session.record(), inputs.refused());
  const bool identical = difference.empty();
  return {.identical = identical, .stopped = false, .difference = std::move(difference)};
}

std::unique_ptr<Session> branch(const Record& record, std::size_t frame, const Stop& stop,
                                const std::function<void(const Session&)>& ticked) {
  require_simulated(record);
  if (!record.navigator.empty())
    throw InputError("a run with an external navigator cannot be continued");
  if (frame >= record.frames.size())
    throw InputError("frame " + std::to_string(frame) + ": the run has " +
                     std::to_string(record.frames.size()));
  auto session = std::make_unique<Session>(Experiment{record.scene, build_world(record.scene), {}},
                                           SessionParts{.trial = record.trial});
  Inputs inputs(record, *session);
  for (std::size_t i = 0; i <= frame && record.frames[i].state != NavigatorState::end; ++i) {
    inputs.give(i);
    if (!session->step(stop) || stop()) return nullptr;
    if (ticked) ticked(*session);
  }
  if (!inputs.refused().empty()) throw InputError(inputs.refused());
  return session;
}

}  // namespace microswarm::experiment
