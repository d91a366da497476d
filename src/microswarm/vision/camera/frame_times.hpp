// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace microswarm::vision {

/// Times of pictures [s], ascending: a number a line, or the column `t_s` of a table that names its
/// columns. Commas, semicolons or tabs separate columns; empty lines and those of '#' are skipped.
/// Throws InputError "NAME:LINE: WHY".
std::vector<double> parse_frame_times(std::string_view text, std::string_view name);
/// The same of a file; throws InputError also if it cannot be read.
std::vector<double> read_frame_times(const std::filesystem::path& file);

/// Whether a table beside a video is the one that VideoRecorder writes, also if a spreadsheet saved
/// it again.
bool is_recorded_table(std::string_view text);
/// Whether a table names a column of times, and none of robots.
bool has_times_column(std::string_view text);

/// Whether a text begins like UTF-16, as some programs save tables.
bool is_utf16(std::string_view text);
/// Throws InputError "NAME: WHY" for such a text.
void refuse_utf16(std::string_view text, std::string_view name);

/// Times of a video's pictures [s] since its first, from those in its file, which are rounded to
/// whole ticks: as long as every picture is within a tick of its place in an even row of the mean
/// rate, it takes that place, so that an even video stays even. From the first that is not, times
/// are those in the file. A picture without a time, or with one that is not after the picture
/// before, is placed 1/rate after that.
class ContainerClock {
 public:
  /// `rate` is the mean rate [1/s], above 0; `tick` the unit of the times [s].
  ContainerClock(double rate, double tick) : rate_(rate), tick_(tick) {}
  /// Time of the next picture, given its time in the file.
  double next(std::optional<double> in_file);

  double last() const { return last_; }
  /// Largest time between two pictures, at least 1/rate.
  double widest() const;
  /// Lines for people on uneven and on missing times.
  std::vector<std::string> notes() const;

 private:
  double rate_;
  double tick_;
  std::optional<double> zero_;
  double last_ = 0;
  int count_ = 0;
  int missing_ = 0;
  bool is_even_ = true;  ///< so far
  double shortest_ = 0;
  double longest_ = 0;
};

}  // namespace microswarm::vision
