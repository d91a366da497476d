// SPDX-License-Identifier: Apache-2.0
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <new>
#include <system_error>
#include <thread>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/text/file.hpp"
#include "microswarm/core/text/text.hpp"
#include "support/cli.hpp"

namespace microswarm::cli {
namespace {

/// Throws InputError, unless the output was a terminal that was closed.
void output_failed(int error) {
  if (error == EPIPE) {
    std::signal(SIGPIPE, SIG_DFL);
    std::raise(SIGPIPE);
  }
  struct stat to {};
  if (error == EIO && ::fstat(STDOUT_FILENO, &to) == 0 && S_ISCHR(to.st_mode)) {
    std::clearerr(stdout);  // the terminal was closed: nobody reads it
    return;
  }
  throw InputError("stdout: cannot write: " + std::generic_category().message(error));
}

}  // namespace

void put(std::string_view text) {
  const std::string safe = printable(text);
  if (std::fwrite(safe.data(), 1, safe.size(), stdout) != safe.size()) output_failed(errno);
}

void flush_output() {
  if (std::fflush(stdout) != 0) output_failed(errno);
}

void keep_input(const std::string& out, const std::string& in) {
  namespace fs = std::filesystem;
  std::error_code none;
  if (out.empty() || in.empty() || in == "/dev/stdin") return;
  if (fs::equivalent(out, in, none) ||
      fs::weakly_canonical(out, none) == fs::weakly_canonical(in, none))
    throw InputError(out, "is the input, which would be lost");
}

OutFolder::OutFolder(const std::string& folder) {
  if (folder.empty()) return;
  std::error_code none;
  for (std::filesystem::path at = std::filesystem::absolute(folder, none).lexically_normal();
       at.has_relative_path() && !std::filesystem::exists(at, none); at = at.parent_path())
    made_.push_back(at);
  make_folder(folder);
  folder_ = open_descriptor(folder, O_RDONLY | O_DIRECTORY);
  if (!folder_) return;
  // A reader that looks whether it is locked holds it for microseconds.
  constexpr int attempts = 20;
  for (int k = 0; ::flock(folder_.get(), LOCK_EX | LOCK_NB) != 0; ++k) {
    if (errno != EWOULDBLOCK) return;
    if (k == attempts) throw InputError(folder, "another command is writing to it");
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  clear_staged(folder);
}

OutFolder::~OutFolder() {
  if (!folder_) return;
  for (const std::filesystem::path& folder : made_)
    if (::rmdir(folder.c_str()) != 0 && errno != ENOENT) break;
}

BeginProgress progress_bars() {
  return [](const std::string& label) {
    return [bar = std::make_shared<ProgressBar>(label)](double share, const std::string& doing) {
      bar->update(share, doing);
    };
  };
}

std::filesystem::path scenario_folder(std::error_code& error) {
  const auto program = std::filesystem::read_symlink("/proc/self/exe", error);
  const auto bin = program.parent_path();
  for (const char* from : {"../../../scenarios", "../share/microswarm/scenarios"}) {
    const auto folder = (bin / from).lexically_normal();
    if (std::filesystem::is_directory(folder, error)) return folder;
  }
  error = std::make_error_code(std::errc::no_such_file_or_directory);
  return {};
}

std::filesystem::path scenario_folder() {
  std::error_code error;
  auto folder = scenario_folder(error);
  if (!error) return folder;
  throw InputError(
      "the program's scenarios are neither in ../../../scenarios nor in "
      "../share/microswarm/scenarios, as seen from its folder");
}

}  // namespace microswarm::cli
