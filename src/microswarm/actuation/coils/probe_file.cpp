// SPDX-License-Identifier: Apache-2.0
#include "microswarm/actuation/coils/probe_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdint>
#include <system_error>
#include <utility>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/text/csv.hpp"
#include "microswarm/core/text/lines.hpp"
#include "microswarm/core/text/text.hpp"

namespace microswarm::actuation {
namespace {

constexpr std::size_t max_row = 4096;        // [bytes]
constexpr std::size_t max_piece = 1U << 20;  // read at once [bytes]
constexpr double max_probe_field = 1e4;      // [mT]

std::size_t read_at(int file, std::uint64_t at, std::string& bytes, const std::string& name) {
  ssize_t n = 0;
  do n = ::pread(file, bytes.data(), bytes.size(), static_cast<off_t>(at));
  while (n < 0 && errno == EINTR);
  if (n < 0)
    throw InputError(name, fmt::format("cannot read: {}", std::generic_category().message(errno)));
  return static_cast<std::size_t>(n);
}

}  // namespace

ProbeRows::ProbeRows(std::string_view header, std::string name) : name_(std::move(name)) {
  separator_ = csv_separator(header);
  const std::vector<std::string_view> names = csv_cells(header, separator_);
  columns_ = names.size();
  const auto find = [&](std::string_view column) -> std::optional<std::size_t> {
    const auto found = std::find(names.begin(), names.end(), column);
    if (found == names.end()) return std::nullopt;
    return static_cast<std::size_t>(found - names.begin());
  };
  constexpr std::array<std::string_view, 3> fields{"bx_mt", "by_mt", "bz_mt"};
  for (std::size_t k = 0; k < 3; ++k) {
    const auto at = find(fields[k]);
    if (!at) throw InputError(name_, fmt::format("column '{}' is missing", fields[k]));
    field_[k] = *at;
  }
  time_ = find("t_s");
}

void ProbeRows::skip(bool has_begun) {
  unfinished_.clear();
  skipping_ = has_begun;
}

void ProbeRows::take(std::string_view bytes, std::vector<Eigen::Vector3d>& fields) {
  while (!bytes.empty()) {
    const std::size_t end = bytes.find('\n');
    const bool is_whole = end != std::string_view::npos;
    if (!skipping_) unfinished_ += bytes.substr(0, end);
    if (unfinished_.size() > max_row)
      throw InputError(name_, fmt::format("a row is longer than {} bytes", max_row));
    bytes.remove_prefix(is_whole ? end + 1 : bytes.size());
    if (!is_whole) return;
    if (!std::exchange(skipping_, false)) take_row(unfinished_, fields);
    unfinished_.clear();
  }
}

void ProbeRows::take_row(std::string_view row, std::vector<Eigen::Vector3d>& fields) {
  const std::string_view text = trimmed(row);
  if (text.empty() || text.front() == '#') return;
  const std::vector<std::string_view> cells = csv_cells(text, separator_);
  if (cells.size() != columns_)
    throw InputError(name_, fmt::format("{} has {} fields, the header has {}", quote(text),
                                        cells.size(), columns_));
  const auto number = [&](std::size_t column, double most) {
    const std::optional<double> value = parse_number(csv_number(cells[column], separator_));
    if (!value || !(std::abs(*value) <= most))
      throw InputError(name_, fmt::format("{} must be a number of at most {}", quote(cells[column]),
                                          number_text(most)));
    return *value;
  };
  const Eigen::Vector3d field{number(field_[0], max_probe_field),
                              number(field_[1], max_probe_field),
                              number(field_[2], max_probe_field)};
  if (time_) {
    const double t = number(*time_, 1e12);
    if (newest_ && t <= *newest_) return;
    newest_ = t;
  }
  fields.push_back(field);
}

ProbeFile::ProbeFile(std::filesystem::path path)
    : path_(std::move(path)),
      name_(path_.string()),
      file_(open_descriptor(path_, O_RDONLY | O_NONBLOCK)) {
  if (!file_)
    throw InputError(name_, fmt::format("cannot read: {}", std::generic_category().message(errno)));
  struct stat info {};
  if (::fstat(file_.get(), &info) != 0 || !S_ISREG(info.st_mode))
    throw InputError(name_, "cannot read: is no regular file");
  std::string start(max_row, '\0');
  start.resize(read_at(file_.get(), 0, start, name_));
  const std::size_t end = start.find('\n');
  if (end == std::string::npos)
    throw InputError(name_, "a header with the columns bx_mt, by_mt, bz_mt is missing");
  rows_.emplace(trimmed(std::string_view(start).substr(0, end)), name_);
  at_ = end + 1;
}

std::uint64_t ProbeFile::size() const {
  struct stat here {
  }, there{};
  if (::fstat(file_.get(), &here) != 0 || ::stat(path_.c_str(), &there) != 0 ||
      here.st_ino != there.st_ino || here.st_dev != there.st_dev ||
      static_cast<std::uint64_t>(here.st_size) < at_)
    throw InputError(name_, "was cut short or replaced while it was read");
  return static_cast<std::uint64_t>(here.st_size);
}

void ProbeFile::skip_to_end() {
  const std::uint64_t end = size();
  const std::uint64_t size_of_last = std::min<std::uint64_t>(end, max_row);
  std::string last(size_of_last, '\0');
  last.resize(read_at(file_.get(), end - size_of_last, last, name_));
  at_ = end;
  rows_->skip(!last.empty() && last.back() != '\n');
  last.resize(last.find_last_not_of("\r\n") + 1);
  last_row_ = trimmed(last.substr(last.rfind('\n') + 1));
}

void ProbeFile::read(std::vector<Eigen::Vector3d>& fields) {
  const std::uint64_t end = size();
  if (end == at_) return;
  std::string bytes(std::min<std::uint64_t>(end - at_, max_piece), '\0');
  bytes.resize(read_at(file_.get(), at_, bytes, name_));
  at_ += bytes.size();
  rows_->take(bytes, fields);
}

}  // namespace microswarm::actuation
