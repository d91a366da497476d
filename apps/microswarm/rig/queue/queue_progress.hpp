// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "microswarm/rig/queue/queue_state.hpp"
#include "rig/keys/rig_keys.hpp"
#include "support/cli.hpp"
#include "support/service_manager.hpp"

namespace microswarm::cli {

/// Table of a queue's state for a person, one line for each item.
std::string queue_table(const rig::QueueState& state);

/// Connection of a queue between its runs to people and services: a status line, emergency keys,
/// the manager of services. A thread gives signs of life while the coils are not driven, unless the
/// queue stands still for longer than 10 min.
class QueueProgress {
 public:
  QueueProgress(ServiceManager& service, const Context& context);
  ~QueueProgress();
  QueueProgress(const QueueProgress&) = delete;
  QueueProgress& operator=(const QueueProgress&) = delete;

  /// Shows what the queue does.
  void show(const std::string& doing);
  /// Waits, with keys: an emergency key halts the queue, q stops it.
  void wait(double seconds);
  /// Leaves terminal and keys to a run.
  void begin_run();
  bool stops() const { return stops_ || context_.stop.requested(); }
  /// Why the queue was halted; empty otherwise.
  std::string halts() const { return halts_ ? "the emergency key was pressed" : ""; }

 private:
  void live();

  ServiceManager& service_;
  const Context& context_;
  std::optional<StatusLine> line_;
  std::optional<RigKeys> keys_;
  std::atomic<bool> stops_ = false, halts_ = false, over_ = false;
  std::atomic<double> shown_;  // time of the last sign of the queue [s]
  double told_ = 0;            // time of the last status to the manager [s]
  std::string doing_;
  std::thread thread_;
};

}  // namespace microswarm::cli
