// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "microswarm/config/type.hpp"
#include "microswarm/core/fields/fields.hpp"
#include "microswarm/rig/watch/fault.hpp"

namespace microswarm::rig {

/// End of an attempt to run an item of a queue.
enum class AttemptEnd {
  running,      ///< it has not ended
  done,         ///< it ran to its end, of any status
  fault,        ///< it ended with a fault
  refused,      ///< it did not begin: the scenario does not fit the rig
  stopped,      ///< the queue was stopped
  interrupted,  ///< the program or the computer ended
};
constexpr auto enum_names(AttemptEnd) {
  return std::array<std::pair<AttemptEnd, std::string_view>, 6>{
      {{AttemptEnd::running, "running"},
       {AttemptEnd::done, "done"},
       {AttemptEnd::fault, "fault"},
       {AttemptEnd::refused, "refused"},
       {AttemptEnd::stopped, "stopped"},
       {AttemptEnd::interrupted, "interrupted"}}};
}

/// State of an item of a queue.
enum class ItemState {
  waiting,  ///< it is run when it is its turn
  cooling,  ///< the coils are too hot for it
  running,
  done,
  failed,   ///< it is not tried again
  dropped,  ///< it, or its scenario, is no longer in the queue
};
constexpr auto enum_names(ItemState) {
  return std::array<std::pair<ItemState, std::string_view>, 6>{{{ItemState::waiting, "waiting"},
                                                                {ItemState::cooling, "cooling"},
                                                                {ItemState::running, "running"},
                                                                {ItemState::done, "done"},
                                                                {ItemState::failed, "failed"},
                                                                {ItemState::dropped, "dropped"}}};
}

/// One attempt to run an item. Times are dates with the local time, ISO 8601.
struct QueueAttempt {
  std::string folder{};  ///< with record and log, in the queue's folder
  std::string began{};
  std::string ended{};
  AttemptEnd end = AttemptEnd::running;
  std::string status{};  ///< of the run: goal reached, time limit, …
  FaultKind fault = FaultKind::none;
  std::string reason{};
  double seconds = 0;                         ///< duration of the run [s]
  std::optional<double> start_temperature{};  ///< of the hottest coil [°C]
  std::optional<double> max_temperature{};    ///< of the coil nearest to its limit [°C]
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.folder, plain("folder", "Folder of record and log."));
    visit(self.began, plain("began", "Begin, date and local time."));
    visit(self.ended, plain("ended", "End, date and local time."));
    visit(self.end, plain("end", "How it ended."));
    visit(self.status, plain("status", "Status of the run."));
    visit(self.fault, plain("fault", "Source of the fault."));
    visit(self.reason, plain("reason", "Why it ended so."));
    visit(self.seconds, s("duration", "Duration of the run."));
    visit(self.start_temperature, degc("start_temperature", "Of the hottest coil at the start."));
    visit(self.max_temperature, degc("max_temperature", "Of the coil nearest to its limit."));
  }
};

/// An item of a queue with its attempts.
struct ItemStatus {
  std::string name{};
  int number = 0;  ///< in the queue, from 1
  int repetition = 1;
  std::string scenario{};
  std::string hash{};  ///< of the scenario with its files and settings
  ItemState state = ItemState::waiting;
  std::string note{};  ///< why it waits or failed
  std::vector<QueueAttempt> attempts{};
  std::size_t forgiven = 0;  ///< of them, from the first on: they no longer count
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.name, plain("name", "Name of the entry."));
    visit(self.number, plain("number", "Place in the queue, from 1."));
    visit(self.repetition, plain("repetition", "Which of its runs, from 1."));
    visit(self.scenario, plain("scenario", "Scenario file."));
    visit(self.hash, plain("hash", "Of the scenario with its files and settings."));
    visit(self.state, plain("state", "State of the item."));
    visit(self.note, plain("note", "Why it waits or has failed."));
    visit(self.attempts, plain("attempts", "Attempts to run it."));
    visit(self.forgiven, plain("forgiven", 0, 1e6, "First attempts that no longer count."));
  }
  /// Attempts that count: interrupted ones, and those with a fault that needs no person.
  int interruptions() const;
  int faults() const;
};

/// State of a queue, kept in its folder.
struct QueueState {
  std::string queue{};     ///< file or folder
  std::string rig{};       ///< its file
  std::string rig_hash{};  ///< of its values, see rig_hash()
  double began = 0;        ///< since 1970 [s]
  std::string doing{};     ///< what it does now, or how it ended
  double updated = 0;      ///< since 1970 [s]
  bool active = false;     ///< a program runs it, unless that was killed
  std::vector<ItemStatus> items{};
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.queue, plain("queue", "File or folder of the queue."));
    visit(self.rig, plain("rig", "File of the rig."));
    visit(self.rig_hash, plain("rig_hash", "Of the values of the rig and of its coils."));
    visit(self.began, s("began", 0, 1e11, "Begin, since 1970."));
    visit(self.doing, plain("doing", "What it does now, or how it ended."));
    visit(self.updated, s("updated", 0, 1e11, "Last change, since 1970."));
    visit(self.active, plain("active", "A program runs it, unless that was killed."));
    visit(self.items, plain("items", "What is run, in this order."));
  }
  /// Items in a state.
  int count(ItemState state) const;
};

/// File with the state of the queue in this folder.
std::filesystem::path queue_state_file(const std::filesystem::path& folder);
/// Whether a program has locked the folder, as one that runs a queue does.
bool is_in_use(const std::filesystem::path& folder);
/// State of the queue in a folder; nothing if there is none. Throws InputError for a damaged file.
std::optional<QueueState> read_queue_state(const std::filesystem::path& folder);
/// Replaces the state atomically, on the disk when it returns. Throws InputError.
void write_queue_state(const std::filesystem::path& folder, const QueueState& state);

/// The same for a reader: `active` says whether a program runs it. Throws InputError without one.
QueueState show_queue_state(const std::filesystem::path& folder);

/// Table of the attempts as CSV, one line each, and one for each item without an attempt.
std::string summary_csv(const QueueState& state);

}  // namespace microswarm::rig
