// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "microswarm/vision/tracking/video_tracks.hpp"

namespace microswarm::cli {

/// Files that write_motion writes.
inline constexpr const char* motion_files[] = {"drift.csv",        "msd.csv",    "robots.csv",
                                               "trajectories.png", "motion.png", "motion.svg",
                                               "motion.pdf"};

/// `track --motion`: writes drift, mean squared displacements and the motion of each robot as
/// tables, their diagrams (motion.png, .svg, .pdf) and a picture of the trajectories over `picture`
/// into the folder, and notes on stderr what is doubtful. With `remove_drift` all but drift.csv is
/// without the common drift. Returns the figures for --json.
nlohmann::ordered_json write_motion(const vision::TrackResult& result,
                                    const formats::Image& picture, bool remove_drift,
                                    const std::filesystem::path& folder);

/// The figures in a few lines.
std::string motion_summary(const nlohmann::ordered_json& motion);

}  // namespace microswarm::cli
