// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "microswarm/core/execution/progress.hpp"
#include "microswarm/core/execution/stop.hpp"
#include "microswarm/core/maths/infinity.hpp"
#include "microswarm/experiment/record/record.hpp"
#include "microswarm/report/run_report.hpp"

namespace microswarm::report {

/// Options of a video of a run.
struct RunVideoOptions {
  double from = 0;           ///< first time shown [s]
  double to = infinity;      ///< last time shown; at most the run's end [s]
  double speed = 1;          ///< seconds of the run per second of the video
  double rate = 30;          ///< frame rate [Hz]
  int width = 1280;          ///< of a picture [px]; rounded up to an even number
  ReportOptions report{};    ///< photograph beneath
  BeginProgress progress{};  ///< display of the progress
};

/// Maximum number of pictures of a video.
inline constexpr int max_video_pictures = 200'000;

/// Result of `write_run_video`.
struct RunVideo {
  std::filesystem::path file{};  ///< the video, or a folder of PNG files without a codec
  int pictures = 0;
  bool stopped = false;  ///< whether the caller stopped it; the video ends early
};

/// Writes the picture that a video of the run shows at time `t` [s], not before the first frame, as
/// .svg, .pdf or .png. Throws InputError if the record has no frames or the file cannot be written.
void write_run_picture(const experiment::Record& record, double t,
                       const std::filesystem::path& file, const RunVideoOptions& options = {});

/// Writes a run as video (.mp4, .mkv, .avi, .gif), with scale bar and time: walls, obstacles, the
/// path travelled and planned, the swarm or the robots. Between two frames of the record the swarm
/// moves on a straight line and obstacles by their motion; robots stay at their last recorded
/// positions. Throws InputError if the record has no frames in the time shown, the video would
/// have more than max_video_pictures pictures, or the file cannot be written.
RunVideo write_run_video(const experiment::Record& record, const std::filesystem::path& file,
                         const RunVideoOptions& options = {}, const Stop& stop = {});

}  // namespace microswarm::report
