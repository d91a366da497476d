// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "microswarm/report/run_report.hpp"

namespace microswarm {

/// write_run_report for a run of robots that are told apart: where they were at first, on the way
/// and at the end, and how far they had to go over time.
void write_robots_report(const Record& record, const std::filesystem::path& folder,
                         const ReportOptions& options);

}  // namespace microswarm
