// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "lab/stream/stream.hpp"
#include "microswarm/core/execution/stop.hpp"

namespace microswarm::lab {

/// Sends a session's state to pages. It keeps every tick's numbers and the state sent so far.
class Publisher {
 public:
  /// Sends a message to one page, or to all (0).
  using Send = std::function<void(std::uint64_t page, MessagePtr)>;
  static constexpr std::chrono::milliseconds frame_period{33};

  explicit Publisher(Send send) : send_(std::move(send)) {}

  /// Resets everything except the speed, for a reopened session.
  void clear();
  /// Takes the frames and events of an opened record.
  void take(const experiment::Record& record);
  /// Takes the frames and events added since.
  void take_more(const experiment::Record& record);
  void take(const experiment::Tick& tick);
  /// Marks that a new frame can be sent.
  void freshen() { is_fresh_ = true; }
  bool is_fresh() const { return is_fresh_; }
  /// Marks that the standing has to be sent.
  void changed() { has_changed_ = true; }
  bool has_rows() const { return !rows_.empty(); }
  std::size_t rows() const { return rows_.size(); }
  /// Time of the newest row [s].
  double newest() const { return rows_.empty() ? 0 : rows_.back().t; }
  /// Earliest time of the next frame message.
  Stop::Clock::time_point next_frame() const { return published_ + frame_period; }

  /// Sends the full state to one page. `shown` is the session itself, or the playback shown.
  void welcome(std::uint64_t page, const MessagePtr& hello, experiment::Session& session,
               const experiment::Session& shown, const experiment::SessionView& view);
  /// Sends news to all pages, when due.
  template <class View>
  void publish(experiment::Session& session, const experiment::Session& shown, View&& view) {
    if (is_fresh_ && Stop::Clock::now() >= next_frame()) tell_frame(shown, view());
    if (has_changed_) tell_standing(session);
  }
  /// Sets a scenario value and informs all pages.
  void set(experiment::Session& session, const Request& request, Issues& issues);

  void tell_standing(experiment::Session& session);
  /// Sends the scenario of the run, or that at the shown frame of a record, if another was sent
  /// last.
  void tell_scenario(const experiment::Session& shown, std::uint64_t frame = 0);
  /// Sends the standing and the numbers of every tick so far to all pages.
  void tell_all(experiment::Session& session) {
    tell_rows();
    tell_standing(session);
  }

  Standing standing;

 private:
  void add(const Row& row);
  void tell_frame(const experiment::Session& shown, const experiment::SessionView& view);
  void tell_rows();

  Send send_;
  std::vector<Row> rows_;
  std::vector<experiment::RunEvent> events_;
  std::size_t changes_ = 0;  ///< number of those of a record
  std::size_t told_rows_ = 0;
  std::size_t told_events_ = 0;
  std::uint64_t told_plans_ = 0;
  /// Number of a record's changes in the scenario sent last; nothing for a run's scenario.
  std::optional<std::size_t> told_changes_{};
  std::vector<AggregationNode> told_nodes_;  ///< tree of the aggregation
  bool is_fresh_ = false;
  bool has_changed_ = false;
  Stop::Clock::time_point published_{};  ///< time of the last frame message
};

}  // namespace microswarm::lab
