// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "microswarm/core/progress.hpp"
#include "microswarm/core/stop.hpp"
#include "microswarm/learning/follower_comparison.hpp"
#include "microswarm/report/rows.hpp"

namespace microswarm::reproduce {

/// The comparison as rows of the figure "follower": the paper gives no figures of its controller,
/// the aims are ours.
std::vector<ReproduceRow> follower_rows(const std::vector<FollowerOutcome>& outcomes);

/// Every follower on every task, one line each.
std::string follower_csv(const std::vector<FollowerOutcome>& outcomes);

/// follower.csv; distance from the path, turning of the field and time as boxes in follower.png,
/// .svg and .pdf; the distance along one of the paths in follower-trace.
void write_follower_figures(const std::vector<FollowerOutcome>& outcomes,
                            const ComparisonOptions& options, const std::filesystem::path& folder);

/// [drrt]'s learned follower beside pure pursuit and the expert.
std::vector<FollowerOutcome> compare_with_progress(ComparisonOptions options,
                                                   const BeginProgress& progress, const Stop& stop);

}  // namespace microswarm::reproduce
