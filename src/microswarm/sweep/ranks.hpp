// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

namespace microswarm {

/// The processes that mpirun (or srun) started together, and messages between them; a single one
/// when the program was started by itself, and then MPI is never touched. To be called by the
/// thread that made it, and made once in a process.
class Ranks {
 public:
  /// Throws InputError when it was started under mpirun and the program was built without MPI.
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
  /// Messages between two ranks arrive in the order in which they are sent.
  void send(int to, const std::string& bytes) const;
  /// One that waits, or nothing.
  std::optional<Message> receive() const;

 private:
  int rank_ = 0;
  int count_ = 1;
};

}  // namespace microswarm
