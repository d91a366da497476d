// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "microswarm/core/execution/stop.hpp"
#include "microswarm/report/rows.hpp"

namespace microswarm::bench {

/// Times of decisions [µs], ours and those of a naive look at the same places.
struct DecisionTimes {
  std::vector<double> ours, naive;
};

/// Guarded decisions on drives across a square among discs or boxes that move steadily, at most 20
/// s each. The square grows with the number of obstacles.
DecisionTimes drive(int obstacles, bool discs, int drives, const Stop& stop);

/// Benchmarks decisions of the radar among few and many obstacles, at random places and on drives,
/// against a naive implementation at the same places; `quick` makes fewer.
std::vector<report::BenchRow> radar(bool quick, const Stop& stop);

}  // namespace microswarm::bench
