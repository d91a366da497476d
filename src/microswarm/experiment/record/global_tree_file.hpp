// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "microswarm/formats/map_file.hpp"
#include "microswarm/planning/global_input/global_tree.hpp"

namespace microswarm {

/// Keeps a grown tree in an HDF5 file, one column a quantity: places [µm] in the map's coordinates
/// less the tree's origin, parents and inputs by their index, and what the tree belongs to: the
/// map's fingerprint, contact rule, length and directions of the inputs, version of the layout.
/// The same tree gives the same bytes.
void write_global_tree(const GlobalTree& tree, const LoadedMap& map,
                       const std::filesystem::path& file);

/// Reads a tree and plays every input of it on the map, so that what is handed on is a tree of this
/// map to the last bit. Throws InputError "FILE: WHY" when the file is none of a tree, has another
/// layout, was grown on another map or by another version that moves robots otherwise, or is
/// damaged.
GlobalTree read_global_tree(const std::filesystem::path& file, const LoadedMap& map);

}  // namespace microswarm
