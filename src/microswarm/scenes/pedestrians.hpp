// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>

#include "microswarm/experiment/scenario/scenario.hpp"
#include "microswarm/formats/tracks.hpp"

namespace microswarm::scenes {

/// Recorded walkers of the UCY set (zara01), as discs among which a swarm of 60 µm/s has to cross.
struct Street {
  Tracks tracks;         ///< 150 µm for a metre
  double recording = 0;  ///< [s]
};

/// Where the recording stands in a folder of data.
std::filesystem::path street_file(const std::filesystem::path& data);

/// `slower` times as slow as they walked: at 8 the fastest makes 50 µm/s, at 2.9 the usual one is
/// as fast as the swarm. Throws InputError as read_ucy_obsmat does.
Street read_street(const std::filesystem::path& file, double slower);

/// Another moment of the recording for each seed, and a start and a goal far apart. No walker is
/// nearer to the swarm's edge at t = 0 than avoidance_start_gap and what it walks in a second. A
/// pure function of its arguments.
Scenario street_scenario(const Street& street, std::uint64_t seed);

}  // namespace microswarm::scenes
