// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "cli.hpp"
#include "microswarm/report/run_report.hpp"

namespace microswarm::cli {

/// A command with what it does in one line and an example of a whole command line.
CLI::App* add_command(CLI::App& parent, const char* name, const char* doc, const char* example);

/// A decimal number within lo..hi: "is -3, allowed 0..100".
CLI::Validator number(double lo, double hi);
/// A whole number within lo..hi.
CLI::Validator whole(std::uint64_t lo, std::uint64_t hi);

/// Options that several commands have.
void add_um_per_px(CLI::App* command, std::optional<double>& value, const char* doc);
void add_settings(CLI::App* command, std::vector<std::string>& values, const char* doc);
void add_json(CLI::App* command, bool& value);

/// `--photo` with its `--um-per-px`, for commands that draw reports.
struct PhotoOptions {
  std::string file;
  std::optional<double> um_per_px;
};
void add_photo(CLI::App* command, PhotoOptions& options);
/// Reads the photograph, if one is named. Throws InputError.
ReportOptions report_options(const PhotoOptions& options);

/// The planner's choice as a file would hold it, so that --set planner.… works as in scenarios;
/// `Planners` is a variant.
template <class Planners>
struct PlannerChoice {
  Planners planner;
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.planner, {"planner", Unit::none, {}, "Planner and its parameters."});
  }
};

/// "11 of 14 aims are met", of rows to reproduce or of a bench.
template <class Row>
std::string aims_met(const std::vector<Row>& rows) {
  const auto aims = std::count_if(rows.begin(), rows.end(), [](const Row& r) { return !!r.aim; });
  const auto met =
      std::count_if(rows.begin(), rows.end(), [](const Row& r) { return r.aim && r.ok(); });
  return fmt::format("{} of {} aims are met\n", met, aims);
}

/// The numbers in "200,500,-90"; empty when it is no such list.
std::vector<double> numbers(const std::string& text);
/// Allows 2 … `most` such numbers; `form` says what is meant.
CLI::Validator place(std::size_t most, const char* form);

}  // namespace microswarm::cli
