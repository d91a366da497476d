// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "microswarm/core/statistics.hpp"
#include "microswarm/reproduce/radar/safety_campaign.hpp"

namespace microswarm::reproduce {

/// One course with all that crossed it.
struct CourseResult {
  Course course;
  std::vector<Contestant> who;
  Crossings crossings;
  std::string extent = "full";  ///< or quick, or interrupted: fewer worlds
};

/// What some crossings of one navigator amount to.
struct Tally {
  int runs = 0;
  double contacts = 0;     ///< a run
  double avoidable = 0;    ///< a run
  double touched = 0;      ///< share of the runs with a contact
  double arrived = 0;      ///< share of the runs
  int runs_avoidable = 0;  ///< runs with an avoidable contact
  int runs_arrived = 0;
  /// Median of time ÷ straight at full speed, of those that arrived; nothing if none did.
  std::optional<double> slowness;
  double delta = 0;               ///< mean avoidance cost
  std::optional<double> turning;  ///< median [°]
};
Tally tally_of(std::span<const Crossing> crossings);

/// "98.4 … 98.9"
std::string percent_between(const ShareInterval& interval);

/// The navigators of which no avoidable contact is asked.
bool is_ours(std::string_view navigator);

/// Writes into `folder`: STEM.csv, STEM-runs.csv and STEM-contacts.csv (a line a navigator and
/// course, a run, a contact; the first is what tools/safety_page.py takes),
/// STEM.html with plots and a table a course, and in STEM-worlds/ the first worlds of avoidable
/// contacts of every navigator as scenarios to run.
void write_safety(const std::vector<CourseResult>& results, const std::filesystem::path& folder,
                  const std::string& stem);

}  // namespace microswarm::reproduce
