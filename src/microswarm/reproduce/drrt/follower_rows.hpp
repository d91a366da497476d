// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "microswarm/core/execution/progress.hpp"
#include "microswarm/core/execution/stop.hpp"
#include "microswarm/learning/follower_comparison.hpp"
#include "microswarm/report/rows.hpp"

namespace microswarm::reproduce {

/// Rows of the figure "follower". The paper gives no values for its controller, so the aims are
/// ours.
std::vector<report::ReproduceRow> follower_rows(
    const std::vector<learning::FollowerOutcome>& outcomes);

/// CSV of every follower on every task, one line each.
std::string follower_csv(const std::vector<learning::FollowerOutcome>& outcomes);

/// Writes follower.csv; box plots of distance from the path, field turning and time as
/// follower.png, .svg and .pdf; and the distance along one path as follower-trace.
void write_follower_figures(const std::vector<learning::FollowerOutcome>& outcomes,
                            const learning::ComparisonOptions& options,
                            const std::filesystem::path& folder);

/// Compares the learned follower of [drrt] with pure pursuit and the expert.
std::vector<learning::FollowerOutcome> compare_with_progress(learning::ComparisonOptions options,
                                                             const BeginProgress& progress,
                                                             const Stop& stop);

}  // namespace microswarm::reproduce
