// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>

#include "microswarm/experiment/record/record.hpp"
#include "microswarm/formats/images/image.hpp"

namespace microswarm::report {

/// Options of a report.
struct ReportOptions {
  std::optional<formats::Image>
      photo{};           ///< background of the pictures, its lower left corner at the origin
  double um_per_px = 1;  ///< of the photo
};

/// Writes a report into `folder`: overview.png, .svg and .pdf (the whole run); moment-1…3.png
/// (world, tree, path, detection circle and swarm at a planning event, and the decision if the
/// record keeps diagnostics); plots.png (planning times;
/// clearance and avoidance cost over time); and index.html with all of them and the metrics.
/// Individually tracked robots have before.png, half-way.png and after.png instead of overview and
/// moments. Throws InputError if the folder cannot be written.
void write_run_report(const experiment::Record& record, const std::filesystem::path& folder,
                      const ReportOptions& options = {});

}  // namespace microswarm::report
