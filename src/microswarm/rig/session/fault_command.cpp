// SPDX-License-Identifier: Apache-2.0
#include "microswarm/rig/session/fault_command.hpp"

#include <fcntl.h>
#include <fmt/core.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <thread>
#include <utility>

#include "microswarm/core/execution/clock.hpp"
#include "microswarm/core/execution/descriptor.hpp"
#include "microswarm/core/execution/spawning.hpp"
#include "microswarm/core/text/text.hpp"

namespace microswarm::rig {
namespace {

using namespace std::chrono_literals;

constexpr double longest_command = 10;  // [s]
constexpr std::size_t longest_path = 4096;

/// Waits for a process, and ends it with its group after `longest_command`. Returns what failed.
std::string waited_for(pid_t process) {
  const double began = steady_seconds();
  siginfo_t info{};
  // Not reaped before its group is ended, so that no other process gets its id.
  while (::waitid(P_PID, static_cast<id_t>(process), &info, WEXITED | WNOHANG | WNOWAIT) == 0 &&
         info.si_pid == 0 && steady_seconds() - began < longest_command)
    std::this_thread::sleep_for(10ms);
  const bool ended = info.si_pid != 0;
  if (!ended) ::kill(-process, SIGKILL);
  for (int status = 0; ::waitpid(process, &status, 0) < 0 && errno == EINTR;) {
  }
  if (!ended) return fmt::format("did not end within {:g} s and was killed", longest_command);
  if (info.si_code != CLD_EXITED) return fmt::format("was ended by signal {}", info.si_status);
  return info.si_status == 0 ? "" : fmt::format("ended with exit code {}", info.si_status);
}

}  // namespace

void FaultCommand::start(const Rig& rig, const std::string& reason,
                         const std::filesystem::path& record) {
  std::erase_if(running_,
                [](const auto& one) { return one.wait_for(0s) == std::future_status::ready; });
  if (rig.params.safety.on_fault.empty()) return;
  std::error_code ignored;
  const std::string folder =
      record.empty() ? "" : std::filesystem::absolute(record, ignored).string();
  running_.push_back(std::async(
      std::launch::async,
      [this, command = rig.params.safety.on_fault, beside = rig.folder,
       variables = std::vector{"MICROSWARM_FAULT=" + one_line(reason),
                               "MICROSWARM_RECORD=" + one_line(folder, longest_path)}] {
        const Descriptor none = open_descriptor("/dev/null", O_RDWR | O_CLOEXEC);
        Spawning spawning;
        spawning.files(none.get(), STDERR_FILENO, STDERR_FILENO);
        if (!beside.empty()) spawning.folder(beside);
        const std::optional<pid_t> process = spawning.start(command, variables);
        const std::string failed = process
                                       ? waited_for(*process)
                                       : fmt::format("cannot be started: {}", std::strerror(errno));
        if (!failed.empty())
          note_(fmt::format("safety.on_fault: {} {}", one_line(command.front(), 80), failed));
      }));
}

}  // namespace microswarm::rig
