// SPDX-License-Identifier: Apache-2.0
#include "microswarm/sweep/same_runs.hpp"

#include <fmt/format.h>

namespace microswarm::sweep {

SameRuns::SameRuns(const std::vector<SweepColumn>& columns) {
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const bool parameter = columns[i].role == SweepColumn::Role::parameter;
    if (columns[i].name == "method" || (parameter && columns[i].name != "seed"))
      settings_.push_back(i);
    if (columns[i].name == "record_hash") record_hash_ = i;
  }
}

void SameRuns::add(std::span<const SqlValue> row) {
  const auto* hash = std::get_if<std::string>(&row[record_hash_]);
  if (!hash) return;
  std::vector<SqlValue> settings;
  for (const std::size_t column : settings_) settings.push_back(row[column]);
  Combination& combination = combinations_[std::move(settings)];
  if (combination.trials++ == 0) combination.record_hash = *hash;
  combination.same = combination.same && combination.record_hash == *hash;
}

std::string SameRuns::note() const {
  std::size_t compared = 0, same = 0;
  for (const auto& [settings, combination] : combinations_) {
    if (combination.trials < 2) continue;
    ++compared;
    same += combination.same;
  }
  if (same == 0) return {};
  if (combinations_.size() == 1) {
    const Combination& only = combinations_.begin()->second;
    return experiment::same_run_note(std::vector(only.trials, only.record_hash));
  }
  return fmt::format(
      "in {} of {} combinations all trials are the same run: nothing in them is random, count them "
      "as one",
      same, compared);
}

}  // namespace microswarm::sweep
