// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "microswarm/experiment/scenario/scene.hpp"
#include "microswarm/io/hdf5_image.hpp"

namespace microswarm::experiment {

/// Writes the scene of a record: /scenario, /map and /tracks, layout in docs/reference/record.md.
void write_scene(io::Hdf5Writer& out, const Scene& scene);

/// Reads a scene bit-exactly. Throws InputError if its parts are inconsistent. A navigator of a
/// former version that is gone is replaced by the safe-interval one, and named in `gone`.
Scene read_scene(const io::Hdf5Reader& in, std::string& gone);

}  // namespace microswarm::experiment
