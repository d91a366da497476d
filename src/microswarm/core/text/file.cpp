// SPDX-License-Identifier: Apache-2.0
#include "microswarm/core/text/file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <system_error>

#include "microswarm/core/execution/descriptor.hpp"

namespace microswarm {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const fs::path& path, std::string_view reason) {
  throw InputError(path.string(), fmt::format("cannot read: {}", reason));
}

[[noreturn]] void fail_errno(const fs::path& path, int error) {
  fail(path, std::generic_category().message(error));
}

}  // namespace

std::string lower_extension(const fs::path& path) {
  std::string text = path.extension().string();
  for (char& c : text)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return text;
}

std::string read_begin(const fs::path& path, std::size_t most) {
  const Descriptor file = open_descriptor(path, O_RDONLY | O_NONBLOCK);
  std::string bytes(most, '\0');
  std::size_t used = 0;
  for (ssize_t n = 1; file && used < most && n > 0;
       used += static_cast<std::size_t>(std::max<ssize_t>(n, 0)))
    n = ::read(file.get(), bytes.data() + used, most - used);
  bytes.resize(used);
  return bytes;
}

std::string read_file(const fs::path& path, std::uint64_t max_bytes, LinkAtFile link) {
  const int no_link = link == LinkAtFile::refused ? O_NOFOLLOW : 0;
  // Opening a pipe must not wait for a writer.
  const Descriptor file = open_descriptor(path, O_RDONLY | O_NONBLOCK | no_link);
  if (!file && no_link != 0 && errno == ELOOP) fail(path, "it is a symbolic link");
  if (!file) fail_errno(path, errno);
  struct stat status {};
  if (::fstat(file.get(), &status) != 0) fail_errno(path, errno);
  if (S_ISDIR(status.st_mode)) fail_errno(path, EISDIR);
  if (S_ISFIFO(status.st_mode)) fail(path, "it is a pipe, not a file");

  std::string bytes;
  std::size_t used = 0;
  bytes.resize(static_cast<std::size_t>(status.st_size) <= max_bytes ? status.st_size + 1 : 1);
  for (;;) {  // terminates: each pass reads something, up to the limit
    const ssize_t n = ::read(file.get(), bytes.data() + used, bytes.size() - used);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) fail_errno(path, errno);
    if (n == 0) break;
    used += static_cast<std::size_t>(n);
    if (used > max_bytes) fail(path, fmt::format("larger than the allowed {} bytes", max_bytes));
    if (used == bytes.size()) bytes.resize(2 * bytes.size());
  }
  bytes.resize(used);
  return bytes;
}

}  // namespace microswarm
