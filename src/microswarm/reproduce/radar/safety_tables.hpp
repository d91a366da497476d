// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "microswarm/core/maths/statistics.hpp"
#include "microswarm/reproduce/radar/safety_campaign.hpp"

namespace microswarm::reproduce {

/// One course with all its results.
struct CourseResult {
  Course course{};
  std::vector<Contestant> who{};
  Crossings crossings{};
  std::string extent = "full";  ///< full, or quick or interrupted with fewer worlds
};

/// Statistics of crossings of one navigator.
struct Tally {
  int runs = 0;
  double contacts = 0;     ///< per run
  double avoidable = 0;    ///< per run
  double touched = 0;      ///< fraction of the runs with a contact
  double arrived = 0;      ///< fraction of the runs
  int runs_avoidable = 0;  ///< runs with an avoidable contact
  int runs_arrived = 0;
  /// Median of time divided by `straight`, over arrivals; empty if there are none.
  std::optional<double> slowness{};
  double delta = 0;                 ///< mean avoidance cost
  std::optional<double> turning{};  ///< median [°]
};
Tally count_tally(std::span<const Crossing> crossings);

/// Text such as "98.4 … 98.9".
std::string percent_between(const ShareInterval& interval);

/// Whether the navigator is required to have no avoidable contacts.
bool is_ours(std::string_view navigator);

/// Writes into `folder`: STEM.csv, STEM-runs.csv and STEM-contacts.csv, with one line per navigator
/// and course, run, and contact (the first is the input of tools/safety_page.py); STEM.html with
/// plots and a table per course; and in STEM-worlds/ the first worlds with avoidable contacts of
/// every navigator, as scenarios.
void write_safety(const std::vector<CourseResult>& results, const std::filesystem::path& folder,
                  const std::string& stem);

}  // namespace microswarm::reproduce
