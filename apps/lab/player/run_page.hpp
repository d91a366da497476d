// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

#include "microswarm/core/execution/progress.hpp"
#include "microswarm/core/execution/stop.hpp"
#include "microswarm/experiment/record/record.hpp"

namespace microswarm::lab {

/// Options of a page with a run.
struct RunPageOptions {
  std::string name = "run.h5";  ///< of the record's file, for the command that repeats it
  std::string photo_jpeg{};     ///< picture beneath the map, its lower left corner at the origin
  double um_per_px = 1;         ///< of the picture
  std::size_t max_bytes = std::size_t{64} << 20;  ///< of messages, before they are compressed
  BeginProgress progress{};                       ///< display of the progress
};

/// Result of `write_run_page`.
struct RunPage {
  std::size_t bytes = 0;   ///< size of the file
  std::size_t frames = 0;  ///< frames in the page
  std::size_t every = 1;   ///< every such frame of the record is in it, and the last one
  bool stopped = false;    ///< whether the caller stopped it; then nothing is written
};

/// Writes a run as one HTML file that plays in a browser without a server or network: the lab's
/// page, and the messages of a session that plays the record. Frames are left out, evenly, where
/// the messages would exceed `max_bytes`. Throws InputError if the record has no frames, single
/// frames are too large, or the file cannot be written.
RunPage write_run_page(const experiment::Record& record, const std::filesystem::path& file,
                       const RunPageOptions& options = {}, const Stop& stop = {});

}  // namespace microswarm::lab
