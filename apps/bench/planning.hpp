// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "microswarm/core/execution/stop.hpp"
#include "microswarm/core/maths/rng.hpp"
#include "microswarm/report/rows.hpp"
#include "microswarm/world/snapshot.hpp"

namespace microswarm::bench {

/// "CPU, compiler, microswarm version, OMPL version, date", for identifying measurements; with the
/// commit that MICROSWARM_COMMIT names.
std::string machine_line();

/// Benchmarks planners, replanning and clearance queries, each with its peer in the same run and
/// world. `scenarios` is the folder of the scenario files; `quick` repeats less.
std::vector<report::BenchRow> planning(const std::filesystem::path& scenarios, bool quick,
                                       const Stop& stop);

/// A path that is asked for.
struct PathQuery {
  Pose2 start;
  Vec2 goal;
};

/// Pairs of free points at least half the map's width apart. Their clearance is doubled, so that
/// the peer, which ends exactly at its goal, can reach them too.
std::vector<PathQuery> far_pairs(const Snapshot& world, double clearance, int count, Rng& rng);

/// Rows with the median and the 99th percentile of our times and of a peer's [ms].
std::vector<report::BenchRow> time_rows(const std::string& name, const std::vector<double>& ours,
                                        const std::vector<double>& theirs, const std::string& peer,
                                        std::optional<double> median_aim,
                                        std::optional<double> p99_aim);

/// Clearance queries of places and edges, one by one and many at once, among discs and polygons.
/// Part of planning().
std::vector<report::BenchRow> clearance_queries(bool quick);

/// Processor time of reading a large grid map, if MICROSWARM_DATA names its folder. Part of
/// planning().
std::vector<report::BenchRow> map_loading(bool quick, const Stop& stop);

/// Exact paths among discs and polygons, and in six grid maps if MICROSWARM_DATA names their
/// folder. Part of planning().
std::vector<report::BenchRow> exact_paths(bool quick, const Stop& stop);

/// Replanning in the two dynamic worlds of [drrt], part of planning().
std::vector<report::BenchRow> replanning(const std::filesystem::path& scenarios, bool quick,
                                         const Stop& stop);

/// FMT* in the S-channel of Fig 3 [drrt], with the same number of samples and radius on both sides:
/// time and length of the first path. Part of planning().
std::vector<report::BenchRow> fmt_star(const std::filesystem::path& scenarios, bool quick,
                                       const Stop& stop);

}  // namespace microswarm::bench
