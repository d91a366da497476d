// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "microswarm/report/picture.hpp"
#include "microswarm/report/run_report.hpp"

namespace microswarm::report {

/// Draws individually tracked robots at a recorded moment, a few of them with their paths until
/// then; only map and goals if the record has no moments.
std::unique_ptr<Picture> draw_robots_at(const experiment::Record& record,
                                        const ReportOptions& options, std::size_t moment);

/// Variant of write_run_report for individually tracked robots: their positions at the start,
/// halfway and at the end, and the remaining distance over time.
void write_robots_report(const experiment::Record& record, const std::filesystem::path& folder,
                         const ReportOptions& options);

}  // namespace microswarm::report
