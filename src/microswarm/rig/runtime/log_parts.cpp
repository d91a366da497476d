// SPDX-License-Identifier: Apache-2.0
#include "microswarm/rig/runtime/log_parts.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <exception>
#include <system_error>
#include <utility>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/errors/write_error.hpp"
#include "microswarm/core/execution/priority.hpp"
#include "microswarm/core/text/durable_rename.hpp"
#include "microswarm/core/text/file.hpp"
#include "microswarm/core/text/text.hpp"

namespace microswarm::rig {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t longest_wait = 16 << 20;  // of lines for the disk [B]

/// Name of the complete part number `n`, from 1: commands-0001.csv. It sorts before commands.csv.
fs::path part_name(const fs::path& log, int n) {
  fs::path name = log;
  return name.replace_filename(
      fmt::format("{}-{:04}{}", log.stem().string(), n, log.extension().string()));
}

bool is_log(const fs::path& file) {
  std::error_code none;
  return fs::exists(fs::symlink_status(file, none));
}

[[noreturn]] void fail_to_write(const fs::path& file) {
  throw WriteError(file.string(),
                   fmt::format("cannot write: {}", std::generic_category().message(errno)));
}

}  // namespace

/// Highest number of the parts in the log's folder, also behind a gap; 0 without parts.
int last_part(const fs::path& log) {
  std::error_code none;
  int last = 0;
  const std::string stem = log.stem().string() + "-", end = log.extension().string();
  const fs::path folder = log.has_parent_path() ? log.parent_path() : fs::path(".");
  for (const auto& entry : fs::directory_iterator(folder, none)) {
    const std::string name = entry.path().filename().string();
    if (!name.starts_with(stem) || !name.ends_with(end)) continue;
    if (name.size() <= stem.size() + end.size()) continue;
    const std::string digits = name.substr(stem.size(), name.size() - stem.size() - end.size());
    const auto number = parse_number(digits);
    if (number && *number >= 1 && *number < 1e6 &&
        part_name(log, static_cast<int>(*number)) == folder / name)
      last = std::max(last, static_cast<int>(*number));
  }
  return last;
}

std::vector<fs::path> log_parts(const fs::path& log) {
  std::vector<fs::path> parts;
  for (int n = 1; is_log(part_name(log, n)); ++n) parts.push_back(part_name(log, n));
  if (is_log(log)) parts.push_back(log);
  return parts;
}

std::string read_log(const fs::path& log) {
  std::string whole, header;
  const std::vector<fs::path> parts = log_parts(log);
  if (parts.empty()) throw InputError(log.string(), "there is no log of this name");
  const int first_missing = static_cast<int>(parts.size()) + (parts.back() == log ? 0 : 1);
  if (const int last = last_part(log); last >= first_missing)
    throw InputError(part_name(log, first_missing).string(),
                     fmt::format("is missing, there is {}", part_name(log, last).string()));
  for (const fs::path& part : parts) {
    std::string text = read_file(part);
    const std::string head = text.substr(0, text.find('\n') + 1);
    if (header.empty()) header = head;
    if (head != header) throw InputError(part.string(), "has another header than the part before");
    whole += whole.empty() ? text : text.substr(head.size());
  }
  return whole;
}

LogParts::LogParts(fs::path log, std::string header, const LogLimits& limits)
    : log_(std::move(log)),
      part_(log_.string() + ".part"),
      header_(std::move(header)),
      limits_(limits) {
  begin_part();
  thread_ = std::thread([this] { run(); });
}

LogParts::~LogParts() {
  join();
  std::error_code none;
  if (is_empty_) fs::remove(part_, none);
}

void LogParts::add(std::string_view line) {
  const std::lock_guard lock(mutex_);
  if (!trouble_.empty()) throw WriteError(trouble_);
  if (waiting_.size() + line.size() > longest_wait)
    throw WriteError(part_.string(), "cannot write: the disk does not answer");
  waiting_ += line;
  is_empty_ = false;
}

std::string LogParts::finish() noexcept {
  join();
  if (trouble_.empty()) {
    try {
      end_part(log_);
      return {};
    } catch (const std::exception&) {  // reported below
      file_ = {};
    }
  }
  return fmt::format("{}: write failed; partial log kept as {}", log_.string(), part_.string());
}

void LogParts::join() {
  {
    const std::lock_guard lock(mutex_);
    ends_ = true;
    wake_.notify_all();
  }
  if (thread_.joinable()) thread_.join();
}

void LogParts::run() {
  lower_priority();
  const std::chrono::duration<double> period(limits_.sync_period);
  bool is_first = true;
  std::unique_lock lock(mutex_);
  for (bool over = false; !over;) {
    over = wake_.wait_for(lock, period, [this] { return ends_; });
    const std::string lines = std::exchange(waiting_, {});
    lock.unlock();
    std::string trouble;
    try {
      if (!lines.empty() && std::exchange(is_first, false))
        for (const fs::path& old : log_parts(log_)) fs::remove(old);
      if (!lines.empty()) take(lines);
    } catch (const std::exception& error) {
      trouble = error.what();
    }
    lock.lock();
    if (trouble.empty()) continue;
    trouble_ = trouble;
    return;
  }
}

/// Writes lines into as many parts as they need, and syncs them.
void LogParts::take(std::string_view lines) {
  while (!lines.empty()) {
    const std::size_t room = limits_.part_bytes - std::min(limits_.part_bytes, size_);
    std::size_t count = lines.size();
    if (count > room) {  // whole lines that still fit
      const std::size_t end = room == 0 ? std::string_view::npos : lines.rfind('\n', room - 1);
      count = end == std::string_view::npos ? 0 : end + 1;
    }
    const bool is_full = count == 0;
    if (is_full && size_ <= header_.size()) count = lines.find('\n') + 1;  // a line of any length
    if (count > 0) {
      write(lines.substr(0, count));
      lines.remove_prefix(count);
    } else {
      end_part(part_name(log_, ++parts_));
      begin_part();
    }
  }
  sync();
}

void LogParts::write(std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t n = ::write(file_.get(), bytes.data(), bytes.size());
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) fail_to_write(part_);
    bytes.remove_prefix(static_cast<std::size_t>(n));
    size_ += static_cast<std::uint64_t>(n);
  }
}

void LogParts::sync() const {
  if (::fdatasync(file_.get()) != 0 && errno != EINVAL) fail_to_write(part_);
}

/// Creates the part that is written, replacing one of this name.
void LogParts::begin_part() {
  std::error_code none;
  fs::remove(part_, none);
  file_ = open_descriptor(part_, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC);
  if (!file_) fail_to_write(part_);
  size_ = 0;
  write(header_);
}

/// Closes the part that is written and gives it its name.
void LogParts::end_part(const fs::path& name) {
  sync();
  if (!file_.close()) fail_to_write(part_);
  if (!rename_durably(part_, name)) fail_to_write(name);
}

}  // namespace microswarm::rig
