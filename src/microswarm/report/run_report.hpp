// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>

#include "microswarm/experiment/record/record.hpp"
#include "microswarm/formats/images/image.hpp"

namespace microswarm {

/// What a report shows besides the record.
struct ReportOptions {
  std::optional<Image> photo;  ///< laid under the pictures, its lower left corner at the origin
  double um_per_px = 1;        ///< of the photo
};

/// Writes into `folder`: overview.png, .svg and .pdf (the whole run), moment-1…3.png (world, tree,
/// path, detection circle and swarm at a planning event), plots.png (planning times; clearance and
/// avoidance cost over time) and index.html with all of them and the numbers; of robots that are
/// told apart before.png, half-way.png and after.png in place of overview and moments. Throws
/// InputError when the folder cannot be written.
void write_run_report(const Record& record, const std::filesystem::path& folder,
                      const ReportOptions& options = {});

}  // namespace microswarm
