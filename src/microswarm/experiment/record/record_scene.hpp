// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "microswarm/experiment/scenario/scene.hpp"
#include "microswarm/io/hdf5_image.hpp"

namespace microswarm {

/// The scene of a record: /scenario, /map and /tracks, layout in docs/reference/record.md.
void write_scene(Hdf5Writer& out, const Scene& scene);

/// Reads it back to the same bits. Throws InputError for what does not fit together.
Scene read_scene(const Hdf5Reader& in);

}  // namespace microswarm
