// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>

#include "microswarm/session/live_session.hpp"
#include "support/cli.hpp"

namespace microswarm::cli {

/// A run's status in one line of at most `columns`; what matters least is left out first.
std::string status_text(const LiveStatus& status, std::size_t columns);

/// The status of a live session as a line on stderr, renewed five times a second at most.
class RigStatusLine {
 public:
  /// The session must outlive it.
  explicit RigStatusLine(const LiveSession& session) : session_(session) {}
  /// Called after each tick.
  void update();

 private:
  const LiveSession& session_;
  StatusLine line_;
  Stop::Clock::time_point next_{};
};

}  // namespace microswarm::cli
