// SPDX-License-Identifier: Apache-2.0
#include "microswarm/rig/queue/run_queue.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <utility>

#include "microswarm/actuation/amplifiers/coil_heat.hpp"
#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/maths/infinity.hpp"
#include "microswarm/core/text/file.hpp"
#include "microswarm/rig/queue/cool_down.hpp"
#include "microswarm/rig/runtime/disk_space.hpp"

namespace microswarm::rig {
namespace {

namespace fs = std::filesystem;

constexpr double look_period = 1;             // at temperatures and the disk [s]
constexpr double write_period = 60;           // of the state during a wait [s]
constexpr double longest_pause = 30 * 86400;  // for a wait [s]

std::string date_of(double wall) {
  return fmt::format("{:%Y-%m-%dT%H:%M:%S%z}", fmt::localtime(static_cast<std::time_t>(wall)));
}

std::string label(const ItemStatus& item) {
  return fmt::format("{:03}-{}-{}", item.number, item.name, item.repetition);
}

std::string times_text(int count) { return count == 1 ? "once" : fmt::format("{} times", count); }

/// Whether an item is to be run.
bool is_open(const ItemStatus& item) {
  return item.state != ItemState::done && item.state != ItemState::failed &&
         item.state != ItemState::dropped;
}

bool was_done(const ItemStatus& item) {
  return std::ranges::count(item.attempts, AttemptEnd::done, &QueueAttempt::end) > 0;
}

class QueueRun {
 public:
  QueueRun(const Queue& queue, const Rig& rig, std::string rig_file, fs::path folder,
           const QueueHost& host)
      : queue_(queue),
        rig_(rig),
        folder_(std::move(folder)),
        host_(host),
        state_(merge_state(queue, read_queue_state(folder_), folder_, host.tell)) {
    // After a power cut it is the same night; a queue that had ended begins another.
    const double began_again = state_.active ? state_.began : host.wall();
    if (state_.began == 0) state_.began = host.wall();
    state_.rig = std::move(rig_file);
    std::string hash = rig_hash(rig);
    if (!state_.rig_hash.empty() && state_.rig_hash != hash)
      host.tell(state_.rig +
                " or its coils have changed since the queue ran: what is done is kept, the rest "
                "runs with them as they are now");
    state_.rig_hash = std::move(hash);
    state_.active = true;
    end_ = queue_end(queue.params, state_.began, began_again);
  }

  QueueEnd run() {
    write("begins");
    std::optional<QueueEnd> early;
    for (std::size_t i = 0; i < queue_.items.size() && !early; ++i)
      while (!early && is_open(state_.items[i]) && !has_no_time(i)) early = attempt(i);
    return finish(early);
  }

 private:
  /// Tries an item once. Returns an end of the queue, if it is one.
  std::optional<QueueEnd> attempt(std::size_t i) {
    ItemStatus& item = state_.items[i];
    if (item.interruptions() > queue_.params.interruptions) {
      fail(item, "was interrupted " + times_text(item.interruptions()));
      host_.tell(fmt::format("{}: {}: has failed; the queue goes on", label(item), item.note));
      host_.alarm(fmt::format("{}: {}; the queue goes on", label(item), item.note), {});
      return std::nullopt;
    }
    if (const auto early = wait_for_disk(i)) return early;
    if (const auto early = cool_down(i)) return early;
    if (has_no_time(i)) return std::nullopt;
    const QueueAttempt& done = run_item(i);
    return judge(item, done, queue_.items[i]);
  }

  QueueAttempt& run_item(std::size_t i) {
    ItemStatus& item = state_.items[i];
    QueueAttempt attempt{.folder = new_folder(item), .began = date_of(host_.wall())};
    if (const auto temperatures = host_.temperatures())
      attempt.start_temperature = temperatures->maxCoeff();
    item.attempts.push_back(attempt);
    item.state = ItemState::running;
    item.note.clear();
    host_.tell(
        fmt::format("{}: begins, at most {:.4g} s", label(item), queue_.items[i].time_budget));
    write(label(item) + ": runs");
    const double began = host_.clock();
    const AttemptResult result = host_.run(queue_.items[i], folder_ / attempt.folder);
    QueueAttempt& now = item.attempts.back();
    now.end = result.end;
    now.status = result.status;
    now.fault = result.fault;
    now.reason = result.reason;
    now.max_temperature = result.max_temperature;
    now.seconds = host_.clock() - began;
    now.ended = date_of(host_.wall());
    return now;
  }

  /// Consequences of an attempt.
  std::optional<QueueEnd> judge(ItemStatus& item, const QueueAttempt& done, const QueueItem& of) {
    const std::string heat =
        done.max_temperature ? fmt::format(", coils up to {:.1f} °C", *done.max_temperature) : "";
    host_.tell(fmt::format("{}: {}{}{}, after {:.1f} s{}", label(item), enum_name(done.end),
                           done.status.empty() ? "" : ", " + done.status,
                           done.reason.empty() ? "" : ": " + done.reason, done.seconds, heat));
    if (done.end == AttemptEnd::done) faults_in_a_row_ = 0;
    switch (done.end) {
      case AttemptEnd::done:
        item.state = ItemState::done;
        write(label(item) + ": is done");
        return std::nullopt;
      case AttemptEnd::stopped:
        item.state = ItemState::waiting;
        return QueueEnd::stopped;
      case AttemptEnd::refused:
        fail(item, done.reason);
        return count_failure(item, label(item) + ": " + done.reason, {});
      case AttemptEnd::fault:
      case AttemptEnd::running:
      case AttemptEnd::interrupted:
        return judge_fault(item, done, of);
    }
    return std::nullopt;
  }

  std::optional<QueueEnd> judge_fault(ItemStatus& item, const QueueAttempt& done,
                                      const QueueItem& of) {
    const std::string what = label(item) + ": " + done.reason;
    const fs::path record = folder_ / done.folder;
    if (needs_person(done.fault)) {
      const bool pauses =
          done.fault == FaultKind::disk && queue_.params.full_disk == FullDisk::pause;
      item.state = ItemState::waiting;
      item.note = "tried again when the queue goes on";
      if (!pauses) return call_person(what, record, "");
    } else if (of.on_fault == AfterFault::retry && item.faults() <= of.retries) {
      item.state = ItemState::waiting;
      item.note = fmt::format("tried again, {} of {}", item.faults(), of.retries);
    } else {
      fail(item, done.reason);
      if (of.on_fault == AfterFault::stop) return call_person(what, record, "");
    }
    return count_failure(item, what, record);
  }

  /// After a fault or a refusal: many in a row have a cause that a person must look for.
  std::optional<QueueEnd> count_failure(const ItemStatus& item, const std::string& what,
                                        const fs::path& record) {
    if (++faults_in_a_row_ >= queue_.params.faults_in_a_row) {
      const std::string many =
          fmt::format("this was attempt {} in a row that failed", faults_in_a_row_);
      return call_person(fmt::format("{}; {}", what, many), record, many);
    }
    host_.tell(fmt::format("{}: {}; the queue goes on", label(item),
                           item.state == ItemState::failed ? "has failed" : item.note));
    host_.alarm(what + "; the queue goes on", record);
    write(what);
    return std::nullopt;
  }

  /// Stops the queue. `told`: of the reason, what the lines before do not say.
  std::optional<QueueEnd> call_person(const std::string& why, const fs::path& record,
                                      const std::string& told) {
    reason_ = why;
    host_.tell(told + (told.empty() ? "" : "; ") + "the queue has stopped for a person");
    host_.alarm(why + "; the queue has stopped", record);
    return QueueEnd::needs_person;
  }

  void fail(ItemStatus& item, const std::string& why) {
    item.state = ItemState::failed;
    item.note = why;
    write(label(item) + ": has failed");
  }

  /// Whether an item's longest run would end after the queue; then it is left out.
  bool has_no_time(std::size_t i) {
    if (!end_ || host_.wall() + queue_.items[i].time_budget <= *end_) return false;
    ItemStatus& item = state_.items[i];
    item.state = ItemState::waiting;
    const std::string why = fmt::format("no time left before {}", date_of(*end_));
    if (std::exchange(item.note, why) != why)
      host_.tell(fmt::format("{}: left out, {}", label(item), why));
    return true;
  }

  /// Waits until an item's coils are cold enough.
  std::optional<QueueEnd> cool_down(std::size_t i) {
    const auto at_first = host_.temperatures();
    if (!at_first) return std::nullopt;
    const auto& coils = rig_.system.amplifiers();
    const std::vector<double>& below = queue_.items[i].start_below;
    const double began = host_.clock();
    return wait_until(i, ItemState::cooling, [&] {
      const double since = host_.clock() - began;
      const CoolDown left =
          cool_down_from(coils, actuation::cooled(coils, *at_first, since), below);
      return Wait{left.seconds, left.seconds > 0 ? to_text(left, rig_.system) : ""};
    });
  }

  /// Waits until the disk has space for an item, or ends the queue.
  std::optional<QueueEnd> wait_for_disk(std::size_t i) {
    const QueueItem& of = queue_.items[i];
    const double needed = needed_space(rig_, of.tick, of.time_budget);
    const auto trouble = [&] {
      const std::optional<double> free = host_.free_space(folder_);
      if (!free || *free >= needed) return std::string();
      return fmt::format("{}: only {:.0f} MB are free on its disk, {} needs {:.0f} MB",
                         folder_.string(), *free / 1e6, label(state_.items[i]), needed / 1e6);
    };
    const std::string full = trouble();
    if (full.empty()) return std::nullopt;
    if (queue_.params.full_disk == FullDisk::stop) {
      state_.items[i].note = full;
      return call_person(full, {}, full);
    }
    host_.alarm(full + "; the queue waits for space", {});  // the wait says it
    return wait_until(i, ItemState::waiting, [&] {
      const std::string why = trouble();
      return Wait{why.empty() ? 0 : look_period, why};
    });
  }

  struct Wait {
    double left = 0;  ///< expected [s]; 0: it has ended
    std::string why{};
  };

  /// Waits while `look` says so; ends the queue if it is stopped, and leaves the item out if the
  /// queue's time ends before.
  template <class Look>
  std::optional<QueueEnd> wait_until(std::size_t i, ItemState as, const Look& look) {
    const double began = host_.clock();
    double written = -infinity;
    for (Wait wait = look(); wait.left > 0; wait = look()) {
      if (const std::string why = host_.halts(); !why.empty()) return call_person(why, {}, why);
      if (host_.stops()) {
        state_.items[i].state = ItemState::waiting;
        return QueueEnd::stopped;
      }
      if (has_no_time(i)) return std::nullopt;
      const double now = host_.clock();
      if (now - began > longest_pause) return call_person(wait.why, {}, wait.why);
      state_.items[i].state = as;
      state_.items[i].note = wait.why;
      if (written == -infinity) host_.tell(fmt::format("{}: {}", label(state_.items[i]), wait.why));
      if (now - written >= write_period) write(wait.why), written = now;
      host_.doing(fmt::format("{}: {}", label(state_.items[i]), wait.why));
      host_.wait(std::clamp(wait.left, 0.01, look_period));
    }
    return std::nullopt;
  }

  /// A folder that does not exist, for the next attempt of an item.
  std::string new_folder(const ItemStatus& item) const {
    const std::string first = label(item);
    std::string name = first;
    std::error_code none;
    const auto is_taken = [&] {
      return fs::exists(folder_ / name, none) ||
             std::ranges::count(item.attempts, name, &QueueAttempt::folder) > 0;
    };
    for (int n = 2; is_taken() && n < 100'000; ++n) name = fmt::format("{}-attempt{}", first, n);
    return name;
  }

  QueueEnd finish(std::optional<QueueEnd> early) {
    const int items = static_cast<int>(queue_.items.size());
    const int done = state_.count(ItemState::done);
    const QueueEnd end = early.value_or(done == items ? QueueEnd::complete : QueueEnd::incomplete);
    std::string text =
        fmt::format("{} of {} done, {} failed", done, items, state_.count(ItemState::failed));
    if (end == QueueEnd::stopped) text = "stopped: " + text;
    host_.tell(text);
    if (end == QueueEnd::needs_person) text = fmt::format("stopped, {}: {}", reason_, text);
    state_.active = false;
    write(text);
    write_file_atomically(folder_ / "summary.csv", summary_csv(state_));
    return end;
  }

  void write(const std::string& doing) {
    state_.doing = doing;
    state_.updated = host_.wall();
    host_.doing(doing);
    write_queue_state(folder_, state_);
  }

  const Queue& queue_;
  const Rig& rig_;
  const fs::path folder_;
  const QueueHost& host_;
  QueueState state_;  // its first items are those of the queue, in order
  std::optional<double> end_;
  int faults_in_a_row_ = 0;
  std::string reason_;  // of the end
};

}  // namespace

QueueState merge_state(const Queue& queue, const std::optional<QueueState>& before,
                       const fs::path& folder,
                       const std::function<void(const std::string&)>& told) {
  QueueState state = before.value_or(QueueState{});
  std::vector<ItemStatus> old = std::exchange(state.items, {});
  state.queue = queue.name;
  for (std::size_t i = 0; i < queue.items.size(); ++i) {
    const QueueItem& of = queue.items[i];
    ItemStatus item{.name = of.name,
                    .number = static_cast<int>(i) + 1,
                    .repetition = of.repetition,
                    .scenario = of.scenario.string(),
                    .hash = of.hash};
    const auto known = std::ranges::find_if(
        old, [&](const ItemStatus& one) { return one.hash == item.hash && one.name == item.name; });
    if (known != old.end()) {
      item.state = known->state;
      item.note = known->note;
      item.attempts = std::move(known->attempts);
      item.forgiven = known->forgiven;
      if (item.state == ItemState::dropped && was_done(item)) item.state = ItemState::done;
      if (item.state == ItemState::dropped) item.state = ItemState::waiting;
      old.erase(known);
    } else if (before) {
      const bool changed = std::ranges::any_of(old, [&](const ItemStatus& one) {
        return one.name == item.name && !one.attempts.empty();
      });
      told(fmt::format("{}: {}", label(item),
                       changed ? "its scenario has changed: it is run again" : "is new"));
    }
    if (is_open(item)) item.state = ItemState::waiting;
    for (QueueAttempt& attempt : item.attempts) {
      if (attempt.end != AttemptEnd::running) continue;
      attempt.end = AttemptEnd::interrupted;
      attempt.reason = "the program or the computer ended";
      const fs::path part = fs::path(attempt.folder) / "run.part.h5";
      std::error_code none;
      if (fs::exists(folder / part, none))
        attempt.reason += "; the record so far is " + part.string();
      told(fmt::format("{}: was interrupted: {}", label(item), attempt.reason));
    }
    state.items.push_back(std::move(item));
  }
  for (ItemStatus& item : old) {
    if (item.attempts.empty()) continue;
    if (item.state != ItemState::dropped)
      told(fmt::format("{}: is no longer in the queue; its records are kept", label(item)));
    item.state = ItemState::dropped;
    state.items.push_back(std::move(item));
  }
  return state;
}

QueueEnd run_queue(const Queue& queue, const Rig& rig, const std::string& rig_file,
                   const fs::path& folder, const QueueHost& host) {
  return QueueRun(queue, rig, rig_file, folder, host).run();
}

}  // namespace microswarm::rig
