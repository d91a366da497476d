// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "microswarm/experiment/record/record.hpp"
#include "microswarm/sweep/sweep_database.hpp"

namespace microswarm::sweep {

/// The trials table as CSV (RFC 4180): a header line, then one line per trial; NULL is empty.
std::string sweep_csv(const SweepReader& sweep);

/// The trials table as an HDF5 file: a one-dimensional dataset per column in `/trials`,
/// with its unit and description as attributes; the sweep file and each cell's scenario as texts.
std::string sweep_hdf5(const SweepReader& sweep);

/// Logs in the format of OMPL's benchmarks, for ompl_benchmark_statistics.py and Planner Arena: a
/// file name and a log for each combination of grid values, with the methods as planners.
std::vector<std::pair<std::string, std::string>> ompl_logs(const SweepReader& sweep);

/// One table of a record as CSV (frames, paths, paths/points, diagnostics/radar, ...), units in the
/// names. In a table
/// of parts, such as the points of all paths, the column `row` is the index of the owner. Throws
/// InputError for an unknown table.
std::string record_csv(const experiment::Record& record, const std::string& table);

}  // namespace microswarm::sweep
