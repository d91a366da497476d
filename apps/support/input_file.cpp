// SPDX-License-Identifier: Apache-2.0
#include "support/input_file.hpp"

#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <filesystem>
#include <optional>
#include <string_view>
#include <system_error>
#include <vector>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/execution/descriptor.hpp"
#include "microswarm/core/text/text.hpp"
#include "support/cli.hpp"

namespace microswarm::cli {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const std::string& name, int error) {
  throw InputError(name, "cannot read: " + std::generic_category().message(error));
}

/// The descriptor that "/dev/stdin", "/dev/fd/63" and the like name.
std::optional<int> named_descriptor(std::string_view name) {
  if (name == "/dev/stdin") return STDIN_FILENO;
  for (const std::string_view folder : {"/dev/fd/", "/proc/self/fd/"}) {
    if (!name.starts_with(folder)) continue;
    const std::string_view number = name.substr(folder.size());
    int descriptor = -1;
    const auto [end, error] =
        std::from_chars(number.data(), number.data() + number.size(), descriptor);
    if (error == std::errc{} && end == number.data() + number.size()) return descriptor;
  }
  return std::nullopt;
}

void write_all(int to, const char* bytes, std::size_t count, const std::string& name) {
  while (count > 0) {
    const ssize_t n = ::write(to, bytes, count);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) fail(name, errno);
    bytes += n;
    count -= static_cast<std::size_t>(n);
  }
}

/// Puts what comes out of a pipe or a terminal into a file in memory, which takes its place.
void keep_in_memory(int pipe, const std::string& name) {
  constexpr std::size_t most = std::size_t{1} << 30;
  struct stat status {};
  if (::fstat(pipe, &status) != 0) fail(name, errno);
  if (S_ISREG(status.st_mode) || S_ISDIR(status.st_mode)) return;
  const Descriptor memory(::memfd_create("input", MFD_CLOEXEC));
  if (!memory) fail(name, errno);
  std::vector<char> buffer(1 << 16);
  std::size_t all = 0;
  const Reading now;
  for (;;) {
    const ssize_t n = ::read(pipe, buffer.data(), buffer.size());
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) fail(name, errno);
    if (n == 0) break;
    all += static_cast<std::size_t>(n);
    if (all > most)
      throw InputError(name, fmt::format("cannot read: larger than the allowed {} bytes", most));
    write_all(memory.get(), buffer.data(), static_cast<std::size_t>(n), name);
  }
  if (::dup2(memory.get(), pipe) < 0) fail(name, errno);
}

/// The shipped file or folder that is meant; nothing if none is.
std::optional<fs::path> shipped(const std::string& name, const std::string& kind) {
  const fs::path wanted = fs::path(name).lexically_normal();
  if (wanted.is_absolute() || wanted.empty() || *wanted.begin() == "..") return std::nullopt;
  std::error_code error;
  const fs::path scenarios = scenario_folder(error);
  if (error) return std::nullopt;
  std::vector<fs::path> files;
  if (*wanted.begin() == "samples")  // in a source tree they are those of the tests
    files = {scenarios / ".." / wanted, scenarios / "../tests" / wanted};
  const fs::path inner =
      *wanted.begin() == "scenarios" ? wanted.lexically_relative("scenarios") : wanted;
  for (const fs::path& folder : {scenarios / kind, scenarios})
    for (const char* extension : {"", ".yaml", ".geojson"}) {
      files.push_back(folder / inner);
      files.back() += extension;
    }
  for (const fs::path& file : files) {
    const bool is_sample = *wanted.begin() == "samples";
    if (fs::is_regular_file(file, error) || (is_sample && fs::is_directory(file, error)))
      return file.lexically_normal();
  }
  return std::nullopt;
}

/// The file in a folder whose name without its extension is nearest to that of `path`, and whose
/// extension is the same unless `path` has none; empty if none is near.
fs::path nearest_file(const fs::path& path, const fs::path& folder) {
  std::vector<std::string> stems;
  std::error_code error;
  fs::directory_iterator entry(folder, error);
  for (; !error && entry != fs::directory_iterator(); entry.increment(error)) {
    const fs::path& file = entry->path();
    const bool has_extension = !path.has_extension() || path.extension() == file.extension();
    if (has_extension && fs::is_regular_file(file, error)) stems.push_back(file.stem());
  }
  std::ranges::sort(stems);
  const std::vector<std::string_view> views(stems.begin(), stems.end());
  fs::path near(nearest_word(path.stem().string(), views));
  if (!near.empty()) near += path.extension();
  return near;
}

/// The file beside it, or the shipped one, whose name is nearest to one that is not there; empty if
/// none is near.
std::string near_file(const std::string& name, const std::string& kind) {
  const fs::path path(name), beside = path.parent_path();
  if (path.has_extension())
    if (const fs::path near = nearest_file(path, beside.empty() ? "." : beside); !near.empty())
      return (beside / near).string();
  std::error_code error;
  const fs::path scenarios = scenario_folder(error);
  if (error || !beside.empty()) return {};
  for (const fs::path& folder : {scenarios / kind, scenarios})
    if (const fs::path near = nearest_file(path, folder); !near.empty()) return near.string();
  return {};
}

}  // namespace

std::string find_input(const std::string& name, const std::string& kind) {
  const std::string file = name == "-" ? "/dev/stdin" : name;
  if (const std::optional<int> descriptor = named_descriptor(file)) {
    keep_in_memory(*descriptor, file);
    return file;
  }
  std::error_code error;
  if (fs::exists(file, error)) return file;
  const std::optional<fs::path> found = shipped(file, kind);
  if (!found) {
    if (const std::string near = near_file(file, kind); !near.empty())
      throw InputError(
          file, fmt::format("cannot read: No such file or directory, did you mean '{}'?", near));
    return file;
  }
  note("note: {}: is not here, the shipped {} is used\n", file, found->string());
  return found->string();
}

}  // namespace microswarm::cli
