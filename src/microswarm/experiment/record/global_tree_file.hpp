// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "microswarm/formats/map_file.hpp"
#include "microswarm/planning/global_input/global_tree.hpp"

namespace microswarm::experiment {

/// Writes a grown tree to an HDF5 file, one dataset per quantity: positions [µm] in map coordinates
/// relative to the tree's origin, parent and input indices, and what the tree depends on: the map's
/// fingerprint, contact rule, length and directions of the inputs, layout version. Equal trees give
/// equal bytes.
void write_global_tree(const planning::GlobalTree& tree, const formats::LoadedMap& map,
                       const std::filesystem::path& file);

/// Reads a tree and replays every input on the map, so the result is bit-exactly a tree of this
/// map. Throws InputError "FILE: WHY" if the file is damaged, is not a tree, has another layout, or
/// was grown on another map or by a version with a different motion model.
planning::GlobalTree read_global_tree(const std::filesystem::path& file,
                                      const formats::LoadedMap& map);

}  // namespace microswarm::experiment
