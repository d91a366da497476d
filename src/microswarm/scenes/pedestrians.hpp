// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>

#include "microswarm/experiment/scenario/scenario.hpp"
#include "microswarm/formats/tracks.hpp"

namespace microswarm::scenes {

/// Recorded pedestrians of the UCY set (zara01), as disc obstacles for a swarm of 60 µm/s.
struct Street {
  formats::Tracks tracks{};  ///< at 150 µm per metre
  double recording = 0;      ///< [s]
};

/// Path of the recording in a data folder.
std::filesystem::path street_file(const std::filesystem::path& data);

/// Reads the recording, slowed down by the factor `slower`: at 8 the fastest pedestrian moves at 50
/// µm/s, at 2.9 a typical one is as fast as the swarm. Throws InputError like read_ucy_obsmat.
Street read_street(const std::filesystem::path& file, double slower);

/// Scenario at a time of the recording chosen by the seed, with a start and a goal far apart. At t
/// = 0 every pedestrian is farther from the swarm's edge than avoidance_start_gap plus its motion
/// in one second. Pure function of its arguments.
experiment::Scenario street_scenario(const Street& street, std::uint64_t seed);

}  // namespace microswarm::scenes
