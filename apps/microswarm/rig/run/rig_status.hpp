// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>

#include "microswarm/rig/session/live_session.hpp"
#include "support/cli.hpp"

namespace microswarm::cli {

/// Status of a run in one line of at most `columns`; the least important parts are omitted first.
std::string status_text(const rig::LiveStatus& status, std::size_t columns);

/// Status of a live session as a line on stderr, updated at most five times a second.
class RigStatusLine {
 public:
  /// The session must outlive the line.
  explicit RigStatusLine(const rig::LiveSession& session) : session_(session) {}
  /// To be called after each tick.
  void update();

 private:
  const rig::LiveSession& session_;
  StatusLine line_;
  Stop::Clock::time_point next_{};
};

}  // namespace microswarm::cli
