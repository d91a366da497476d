// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "microswarm/sweep/table.hpp"

namespace microswarm {

/// What the processes of a sweep say to each other. Those that help report (ready or failed) and
/// send rows; the first gives tasks and says when it is over, which they answer with done.
struct SweepMessage {
  enum class Kind : std::uint8_t { ready, failed, rows, stopped, done, tasks, over };
  Kind kind = Kind::over;
  std::string text;              ///< ready: the plan's hash; failed: why
  std::uint32_t want = 0;        ///< ready, rows: how many more tasks to send
  std::vector<SweepTask> tasks;  ///< tasks
  std::vector<SweepRow> rows;    ///< rows
};

/// The message as bytes, for machines of one kind.
std::string to_bytes(const SweepMessage& message);

/// Reads it back. Throws InputError for bytes that are none.
SweepMessage message_of(std::string_view bytes);

}  // namespace microswarm
