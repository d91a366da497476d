// SPDX-License-Identifier: Apache-2.0
#include "microswarm/vision/camera/frame_times.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/text/csv.hpp"
#include "microswarm/core/text/file.hpp"
#include "microswarm/core/text/lines.hpp"
#include "microswarm/core/text/text.hpp"

namespace microswarm::vision {
namespace {

constexpr std::uint64_t max_times_bytes = 256ULL << 20;
constexpr double max_seconds = 1e12;  // seconds since 1970 are fewer
constexpr std::string_view times_column = "t_s";
constexpr std::array<std::string_view, 3> recorded_header{"frame", "camera_frame", "t_s"};

bool has_a_number(const std::vector<std::string_view>& fields, char separator) {
  return std::ranges::any_of(fields, [&](std::string_view field) {
    return parse_number(csv_number(field, separator)).has_value();
  });
}

/// Cells of the first line of a table.
std::vector<std::string_view> first_cells(std::string_view text) {
  constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
  if (text.starts_with(byte_order_mark)) text.remove_prefix(byte_order_mark.size());
  const std::string_view line = trimmed(text.substr(0, text.find_first_of("\r\n")));
  return csv_cells(line, csv_separator(line));
}

/// Index of the column of times in a header.
std::size_t times_place(const Lines& lines, const std::vector<std::string_view>& names) {
  const auto found = std::ranges::find(names, times_column);
  if (found == names.end())
    lines.fail(
        "no column 't_s' in this header: times in seconds expected, one a line, or a column "
        "of this name");
  return static_cast<std::size_t>(found - names.begin());
}

}  // namespace

std::vector<double> parse_frame_times(std::string_view text, std::string_view name) {
  refuse_utf16(text, name);
  Lines lines(text, name);
  std::vector<double> times;
  std::optional<std::size_t> column;
  std::optional<char> separator;
  while (const std::optional<std::string_view> raw = lines.next()) {
    const std::string_view line = trimmed(*raw);
    if (line.empty() || line.front() == '#') continue;
    const bool is_first = !separator;
    if (is_first) {
      separator = csv_separator(line);
      require_clear_commas(text, name, *separator);
    }
    const std::vector<std::string_view> fields = csv_cells(line, *separator);
    if (is_first && !has_a_number(fields, *separator)) {
      column = times_place(lines, fields);
      continue;
    }
    if (!column && fields.size() != 1)
      lines.fail(
          fmt::format("{} columns without names: one time a line expected, or a header with "
                      "'t_s'",
                      fields.size()));
    if (column.value_or(0) >= fields.size()) lines.fail("no time in this line");
    const std::string_view field = fields[column.value_or(0)];
    const std::optional<double> t = parse_number(csv_number(field, *separator));
    if (!t) lines.fail(quote(field) + " is no time in seconds");
    if (!(std::abs(*t) <= max_seconds))
      lines.fail("time " + number_text(*t) + " s, at most " + number_text(max_seconds));
    if (!times.empty() && !(*t > times.back()))
      lines.fail("time " + number_text(*t) + " s is not after " + number_text(times.back()) + " s");
    times.push_back(*t);
  }
  if (times.empty()) throw InputError(std::string(name), "no times: seconds expected, one a line");
  return times;
}

std::vector<double> read_frame_times(const std::filesystem::path& file) {
  return parse_frame_times(read_file(file, max_times_bytes), file.string());
}

bool is_recorded_table(std::string_view text) {
  return std::ranges::equal(first_cells(text), recorded_header);
}

bool has_times_column(std::string_view text) {
  const std::vector<std::string_view> names = first_cells(text);
  const auto has = [&](std::string_view name) { return std::ranges::count(names, name) > 0; };
  return has(times_column) && !has("id") && !has("particle");
}

bool is_utf16(std::string_view text) {
  return text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF") ||
         (text.size() > 3 && (text[0] == '\0') != (text[1] == '\0') &&
          (text[2] == '\0') == (text[0] == '\0') && (text[3] == '\0') == (text[1] == '\0'));
}

void refuse_utf16(std::string_view text, std::string_view name) {
  if (is_utf16(text)) throw InputError(std::string(name), "is UTF-16: save it as UTF-8");
}

double ContainerClock::next(std::optional<double> in_file) {
  if (!zero_ && in_file) zero_ = *in_file - last_;
  const double even = count_ == 0 ? 0 : last_ + 1 / rate_;
  double t = even;
  if (in_file) {
    const double told = *in_file - *zero_;
    const double nearest = std::round(told * rate_) / rate_;
    const double rounding = std::min(1.01 * tick_, 0.25 / rate_);
    is_even_ = is_even_ && std::abs(nearest - told) <= rounding &&
               (count_ == 0 || std::abs(nearest - last_ - 1 / rate_) < 0.5 / rate_);
    t = is_even_ ? nearest : told;
  }
  if (count_ > 0 && !(t > last_)) in_file.reset(), t = even;
  missing_ += !in_file;
  if (count_ > 0) {
    const double gap = t - last_;
    shortest_ = count_ == 1 ? gap : std::min(shortest_, gap);
    longest_ = std::max(longest_, gap);
  }
  ++count_;
  return last_ = t;
}

double ContainerClock::widest() const { return std::max(longest_, 1 / rate_); }

std::vector<std::string> ContainerClock::notes() const {
  if (missing_ > 0 && missing_ == count_)
    return {fmt::format("the file states no times: its mean rate of {:.6g} Hz is taken", rate_)};
  std::vector<std::string> lines;
  if (longest_ - shortest_ > 2.02 * tick_ + 1e-6 * longest_)
    lines.push_back(
        fmt::format("pictures are {:.4g} to {:.4g} s apart: the times are those in the file",
                    shortest_, longest_));
  if (missing_ > 0)
    lines.push_back(fmt::format(
        "{} of {} pictures have no time after the one before: each is placed {:.4g} s after it",
        missing_, count_, 1 / rate_));
  return lines;
}

}  // namespace microswarm::vision
