// SPDX-License-Identifier: Apache-2.0
#include "microswarm/core/execution/spawning.hpp"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

namespace microswarm {
namespace {

/// Exit code of a program; nothing if it cannot be waited for.
std::optional<int> exit_code(const std::vector<std::string>& command) {
  Spawning spawning;
  spawning.files(STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO);
  const std::optional<pid_t> process = spawning.start(command);
  int status = 0;
  if (!process || ::waitpid(*process, &status, 0) != *process) return std::nullopt;
  return WIFEXITED(status) ? std::optional(WEXITSTATUS(status)) : std::nullopt;
}

// Some service managers and shells leave it so.
TEST(Spawning, AProgramIsWaitedForWhereChildrenWereIgnored) {
  void (*const before)(int) = ::signal(SIGCHLD, SIG_IGN);
  EXPECT_EQ(exit_code({"sh", "-c", "exit 3"}), 3);
  ::signal(SIGCHLD, before);
  EXPECT_EQ(exit_code({"sh", "-c", "exit 4"}), 4);
}

}  // namespace
}  // namespace microswarm
