// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <vector>

#include "lab/stream.hpp"
#include "microswarm/core/execution/stop.hpp"

namespace microswarm::lab {

/// Tells pages of a session: it keeps every tick's numbers, and knows what was told so far.
class Publisher {
 public:
  /// For one page, or for all (0).
  using Send = std::function<void(std::uint64_t page, MessagePtr)>;
  static constexpr std::chrono::milliseconds frame_period{33};

  explicit Publisher(Send send) : send_(std::move(send)) {}

  /// Forgets all but the speed: a session was opened anew.
  void clear();
  /// Takes the frames and events of a record that was opened.
  void take(const Record& record);
  /// Takes those that it has got since.
  void take_more(const Record& record);
  void take(const Tick& tick);
  /// There is a frame to show.
  void freshen() { is_fresh_ = true; }
  bool is_fresh() const { return is_fresh_; }
  /// How the session stands is to be told.
  void changed() { has_changed_ = true; }
  bool has_rows() const { return !rows_.empty(); }
  std::size_t rows() const { return rows_.size(); }
  /// When a frame may be told again.
  Stop::Clock::time_point next_frame() const { return published_ + frame_period; }

  /// Tells a page all. `shown` is looked at; the session itself, or what was recorded so far.
  void welcome(std::uint64_t page, const MessagePtr& hello, Session& session, const Session& shown,
               const SessionView& view);
  /// Tells all pages what is new, when it is time to.
  template <class View>
  void publish(Session& session, const Session& shown, View&& view) {
    if (is_fresh_ && Stop::Clock::now() >= next_frame()) tell_frame(session, shown, view());
    if (has_changed_) tell_standing(session);
  }
  /// Sets a scenario value and tells all pages.
  void set(Session& session, const Request& request, Issues& issues);

  void tell_standing(Session& session);
  /// Tells all pages where the session stands, and the numbers of every tick until then.
  void tell_all(Session& session) {
    tell_rows();
    tell_standing(session);
  }

  Standing standing;

 private:
  void tell_frame(Session& session, const Session& shown, const SessionView& view);
  void tell_rows();

  Send send_;
  std::vector<Row> rows_;
  std::vector<RunEvent> events_;
  std::size_t told_rows_ = 0;
  std::size_t told_events_ = 0;
  std::uint64_t told_plans_ = 0;
  bool told_aggregation_ = false;
  bool is_fresh_ = false;
  bool has_changed_ = false;
  Stop::Clock::time_point published_{};  ///< when a frame was sent last
};

}  // namespace microswarm::lab
