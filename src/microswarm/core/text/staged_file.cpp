// SPDX-License-Identifier: Apache-2.0
#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <system_error>
#include <vector>

#include "microswarm/core/errors/write_error.hpp"
#include "microswarm/core/execution/descriptor.hpp"
#include "microswarm/core/text/durable_rename.hpp"
#include "microswarm/core/text/file.hpp"

namespace microswarm {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail_writing(const fs::path& path, std::string_view reason) {
  throw WriteError(path.string(), fmt::format("cannot write: {}", reason));
}

[[noreturn]] void fail_writing(const fs::path& path, int error) {
  fail_writing(path, std::generic_category().message(error));
}

void write_all(const Descriptor& file, std::string_view bytes, const fs::path& named) {
  while (!bytes.empty()) {
    const ssize_t n = ::write(file.get(), bytes.data(), bytes.size());
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) fail_writing(named, errno);
    bytes.remove_prefix(static_cast<std::size_t>(n));
  }
}

bool is_special(const fs::path& path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  return fs::exists(status) && !fs::is_regular_file(status);
}

constexpr std::string_view staged_mark = ".tmp-microswarm-";  // reserved: no user file contains it

/// Path of this process's nth temporary file for the target.
fs::path staged_for(const fs::path& target, int n) {
  fs::path staged = target;
  return staged.replace_filename(fmt::format("{}{}{}-{}{}", target.stem().string(), staged_mark,
                                             ::getpid(), n, target.extension().string()));
}

/// Process that made a temporary file of this name; 0 for any other name.
pid_t creating_process(const fs::path& file) {
  const std::string name = file.filename().string();
  const auto mark = name.rfind(staged_mark);
  if (mark == std::string::npos) return 0;
  const std::string rest = name.substr(mark + staged_mark.size());
  int program = 0, n = 0, read = 0;
  if (std::sscanf(rest.c_str(), "%d-%d%n", &program, &n, &read) != 2) return 0;
  const auto after = static_cast<std::size_t>(read);
  return after == rest.size() || rest[after] == '.' ? program : 0;
}

}  // namespace

StagedFile::StagedFile(fs::path target, LinkAtFile link)
    : target_(std::move(target)), direct_(link == LinkAtFile::followed && is_special(target_)) {
  if (direct_) {
    staged_ = target_;
    return;
  }
  for (int i = 0; i < 1000; ++i) {
    staged_ = staged_for(target_, i);
    if (open_descriptor(staged_, O_WRONLY | O_CREAT | O_EXCL)) return;
    if (errno != EEXIST) fail_writing(target_, errno);
  }
  fail_writing(target_, EEXIST);
}

StagedFile::~StagedFile() {
  if (!direct_ && !committed_) ::unlink(staged_.c_str());
}

void StagedFile::commit() {
  if (direct_) return;
  Descriptor file = open_descriptor(staged_, O_WRONLY);
  if (!file) fail_writing(target_, errno);
  if (::fsync(file.get()) != 0 || !file.close()) fail_writing(target_, errno);
  if (!rename_durably(staged_, target_)) fail_writing(target_, errno);
  committed_ = true;
}

void clear_staged(const fs::path& folder) {
  std::error_code error, none;
  std::vector<fs::path> left;
  for (fs::directory_iterator at(folder, error); !error && at != fs::directory_iterator();
       at.increment(error)) {
    const pid_t program = creating_process(at->path());
    const bool is_left = program > 0 && ::kill(program, 0) != 0 && errno == ESRCH;
    if (is_left && at->symlink_status(none).type() == fs::file_type::regular)
      left.push_back(at->path());
  }
  for (const fs::path& file : left) fs::remove(file, none);
}

void write_file_atomically(const fs::path& path, std::string_view bytes, LinkAtFile link) {
  StagedFile staged(path, link);
  // Opening a pipe must not wait for a reader, writing may.
  Descriptor file = open_descriptor(staged.path(), O_WRONLY | O_NONBLOCK);
  if (!file && errno == ENXIO) fail_writing(path, "it is a pipe that nobody reads");
  if (!file) fail_writing(path, errno);
  ::fcntl(file.get(), F_SETFL, ::fcntl(file.get(), F_GETFL) & ~O_NONBLOCK);
  write_all(file, bytes, path);
  if (!file.close()) fail_writing(path, errno);
  staged.commit();
}

void make_folder(const std::string& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw InputError(folder, fmt::format("cannot make the folder: {}", error.message()));
  const Descriptor nameless = open_descriptor(folder, O_TMPFILE | O_WRONLY);
  if (!nameless && errno != EOPNOTSUPP && errno != EISDIR)  // O_TMPFILE unsupported: not tested
    throw InputError(folder, "cannot write: " + std::generic_category().message(errno));
}

}  // namespace microswarm
