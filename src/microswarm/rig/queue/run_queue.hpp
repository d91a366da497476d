// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "microswarm/rig/queue/queue.hpp"
#include "microswarm/rig/queue/queue_state.hpp"

namespace microswarm::rig {

/// End of one attempt, with the coils at zero.
struct AttemptResult {
  AttemptEnd end = AttemptEnd::done;
  std::string status{};
  FaultKind fault = FaultKind::none;
  std::string reason{};
  std::optional<double> max_temperature{};  ///< of the coil nearest to its limit [°C]
};

/// Access of a queue to its rig, clock, disk and people; tests replace all of it.
struct QueueHost {
  /// Runs an item into a folder, which may not exist, to its end. Expected to throw nothing.
  std::function<AttemptResult(const QueueItem& item, const std::filesystem::path& folder)> run;
  /// Temperatures of the coils now [°C]; nothing if they are not known, as of simulated coils.
  std::function<std::optional<Eigen::VectorXd>()> temperatures;
  std::function<double()> wall;        ///< time since 1970 [s]
  std::function<double()> clock;       ///< time by a clock that only advances [s]
  std::function<void(double)> wait;    ///< waits for at most this time [s]
  std::function<bool()> stops;         ///< whether the queue shall end in order
  std::function<std::string()> halts;  ///< why a person stopped it at once; empty otherwise
  /// Space that is free for a folder [B].
  std::function<std::optional<double>(const std::filesystem::path&)> free_space;
  std::function<void(const std::string&)> tell;   ///< gets lines of the log
  std::function<void(const std::string&)> doing;  ///< gets what it does now, several times a second
  /// Calls a person; with the folder of the record, or an empty one.
  std::function<void(const std::string& why, const std::filesystem::path& record)> alarm;
};

/// End of a queue.
enum class QueueEnd {
  complete,      ///< every item is done
  incomplete,    ///< some items failed, or there was no time left for them
  stopped,       ///< it was stopped, and can be continued
  needs_person,  ///< after a fault that needs a person; it can be continued
};

/// Runs a queue, or continues it: items that are done or have failed are not run again, one that
/// was running is tried again. Before each the coils cool down below its start temperature, with no
/// current. The state is written to `folder` at every change, the table summary.csv at the end.
/// `rig` has the queue's settings. Throws InputError if the state is damaged or cannot be written.
QueueEnd run_queue(const Queue& queue, const Rig& rig, const std::string& rig_file,
                   const std::filesystem::path& folder, const QueueHost& host);

/// State of a queue that is begun or continues in `folder`, without running it; `told` gets a line
/// for each change and each interruption.
QueueState merge_state(const Queue& queue, const std::optional<QueueState>& before,
                       const std::filesystem::path& folder,
                       const std::function<void(const std::string&)>& told);

}  // namespace microswarm::rig
