// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "microswarm/report/run_report.hpp"

namespace microswarm {

/// Variant of write_run_report for individually tracked robots: their positions at the start,
/// halfway and at the end, and the remaining distance over time.
void write_robots_report(const Record& record, const std::filesystem::path& folder,
                         const ReportOptions& options);

}  // namespace microswarm
