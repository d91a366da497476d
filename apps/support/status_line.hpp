// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "microswarm/core/execution/stop.hpp"

namespace microswarm::cli {

/// Width of a text on a terminal [columns].
std::size_t to_columns(std::string_view text);

/// A line at the end of stderr that is updated in place, on a terminal only. Output of say() and
/// note() appears above it. Of several lines, the last one shown is visible.
class StatusLine {
 public:
  StatusLine();
  /// Removes the line.
  ~StatusLine();
  StatusLine(const StatusLine&) = delete;
  StatusLine& operator=(const StatusLine&) = delete;

  /// Whether stderr is a terminal.
  bool is_there() const { return is_there_; }
  /// Maximum width of the line [columns], so that it never wraps.
  std::size_t columns() const;
  /// Shows a text instead of the last one, cut to columns().
  void show(std::string_view text);

 private:
  bool is_there_;
};

/// "label [#####.....]  50 % 3 s left note" for a share of the work in [0, 1] that took `seconds`.
/// The bar is shorter, or left out, where there are few columns. Before the first share is done
/// no time is said to be left.
std::string progress_text(const std::string& label, double share, double seconds,
                          const std::string& doing, std::size_t columns);

/// Progress bar as a status line, as progress_text.
class ProgressBar {
 public:
  explicit ProgressBar(const std::string& label);
  /// `share` is the completed fraction of the work, in [0, 1].
  void update(double share, const std::string& doing = {});

 private:
  std::string label_;
  StatusLine line_;
  Stop::Clock::time_point began_;
  int last_ = -1;
  std::string note_;
};

}  // namespace microswarm::cli
