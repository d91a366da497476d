// SPDX-License-Identifier: Apache-2.0
#include "microswarm/core/execution/spawning.hpp"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <string_view>

namespace microswarm {
namespace {

std::vector<char*> pointers(std::vector<std::string>& words) {
  std::vector<char*> all;
  all.reserve(words.size() + 1);
  for (std::string& word : words) all.push_back(word.data());
  all.push_back(nullptr);
  return all;
}

std::string_view name_of(std::string_view variable) {
  return variable.substr(0, variable.find('='));
}

/// Ends ignoring children, as a parent may have left it: they vanish before they are waited for.
void mind_children() {
  struct sigaction now {};
  if (::sigaction(SIGCHLD, nullptr, &now) != 0) return;
  if (now.sa_handler == SIG_IGN || (now.sa_flags & SA_NOCLDWAIT) != 0) ::signal(SIGCHLD, SIG_DFL);
}

}  // namespace

Spawning::Spawning() {
  posix_spawn_file_actions_init(&actions_);
  posix_spawnattr_init(&attributes_);
  posix_spawnattr_setflags(&attributes_, POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGDEF |
                                             POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSCHEDULER);
  // No real-time priority of the thread that starts it.
  const sched_param usual{};
  posix_spawnattr_setschedpolicy(&attributes_, SCHED_OTHER);
  posix_spawnattr_setschedparam(&attributes_, &usual);
  sigset_t every, none;
  sigfillset(&every);
  sigemptyset(&none);
  posix_spawnattr_setsigdefault(&attributes_, &every);
  posix_spawnattr_setsigmask(&attributes_, &none);
}

Spawning::~Spawning() {
  posix_spawn_file_actions_destroy(&actions_);
  posix_spawnattr_destroy(&attributes_);
}

void Spawning::files(int in, int out, int err, const std::vector<int>& more) {
  int next = STDERR_FILENO + 1;
  posix_spawn_file_actions_adddup2(&actions_, in, STDIN_FILENO);
  posix_spawn_file_actions_adddup2(&actions_, out, STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&actions_, err, STDERR_FILENO);
  for (const int file : more) posix_spawn_file_actions_adddup2(&actions_, file, next++);
  posix_spawn_file_actions_addclosefrom_np(&actions_, next);
}

void Spawning::folder(const std::filesystem::path& path) {
  posix_spawn_file_actions_addchdir_np(&actions_, path.c_str());
}

std::optional<pid_t> Spawning::start(std::vector<std::string> command,
                                     std::vector<std::string> variables) {
  std::vector<char*> environment = pointers(variables);
  environment.pop_back();
  for (char** one = environ; *one; ++one)
    if (std::ranges::none_of(
            variables, [&](const auto& variable) { return name_of(variable) == name_of(*one); }))
      environment.push_back(*one);
  environment.push_back(nullptr);
  const std::vector<char*> arguments = pointers(command);
  mind_children();
  pid_t process = 0;
  errno = ::posix_spawnp(&process, arguments[0], &actions_, &attributes_, arguments.data(),
                         environment.data());
  if (errno != 0) return std::nullopt;
  return process;
}

}  // namespace microswarm
