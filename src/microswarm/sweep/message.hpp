// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "microswarm/sweep/table.hpp"

namespace microswarm::sweep {

/// A message between the processes of a sweep. Workers report `ready` or `failed` and send rows;
/// rank 0 sends tasks and finally `over`, which workers answer with `done`.
struct SweepMessage {
  enum class Kind : std::uint8_t { ready, failed, rows, stopped, done, tasks, over };
  Kind kind = Kind::over;
  std::string text{};              ///< ready: the plan's hash; failed: the reason
  std::uint32_t want = 0;          ///< ready, rows: how many more tasks to send
  std::vector<SweepTask> tasks{};  ///< tasks
  std::vector<SweepRow> rows{};    ///< rows
};

/// Encodes a message in CBOR; doubles keep every bit.
std::string to_bytes(const SweepMessage& message);

/// Decodes a message. Throws InputError "mpirun: malformed message of … bytes".
SweepMessage parse_message(std::string_view bytes);

}  // namespace microswarm::sweep
