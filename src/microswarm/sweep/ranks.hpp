// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>

namespace microswarm::sweep {

/// A message and the rank that sent it.
struct RankMessage {
  int from = 0;
  std::string bytes{};
};

/// Interface of the MPI module; its lifetime is that of the communication.
class RankMessages {
 public:
  virtual ~RankMessages() = default;
  virtual int rank() const = 0;
  virtual int count() const = 0;
  virtual void send(int to, const std::string& bytes) const = 0;
  virtual std::optional<RankMessage> receive() const = 0;
};

/// The processes started by mpirun or srun, and messages between them. A program started alone has
/// one rank and does not load MPI. Create it once in a process and use it from one thread.
class Ranks {
 public:
  /// Throws InputError under mpirun when the program was built without MPI.
  Ranks();
  /// Only this process, regardless of the launcher.
  static Ranks alone() { return Ranks(nullptr); }

  int rank() const { return messages_ ? messages_->rank() : 0; }
  int count() const { return messages_ ? messages_->count() : 1; }

  /// Sends a message; messages between two ranks keep their order.
  void send(int to, const std::string& bytes) const;
  /// The next pending message, if any.
  std::optional<RankMessage> receive() const;

 private:
  explicit Ranks(std::unique_ptr<RankMessages> messages) : messages_(std::move(messages)) {}

  std::unique_ptr<RankMessages> messages_;
};

}  // namespace microswarm::sweep
