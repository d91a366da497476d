// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

namespace microswarm {

/// The processes started by mpirun or srun, and messages between them. A program started alone has
/// one rank and does not initialise MPI. Create it once in a process and use it from one thread.
class Ranks {
 public:
  /// Throws InputError under mpirun when the program was built without MPI.
  Ranks();
  ~Ranks();
  Ranks(const Ranks&) = delete;
  Ranks& operator=(const Ranks&) = delete;

  int rank() const { return rank_; }
  int count() const { return count_; }

  struct Message {
    int from = 0;
    std::string bytes;
  };
  /// Sends a message; messages between two ranks keep their order.
  void send(int to, const std::string& bytes) const;
  /// The next pending message, if any.
  std::optional<Message> receive() const;

 private:
  int rank_ = 0;
  int count_ = 1;
};

}  // namespace microswarm
