// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

namespace microswarm::formats {

/// Extension for the format of a map file: its own in lower case; for a file without
/// one, such as standard input, that of the format of its content, or none.
std::string map_extension(const std::filesystem::path& file);

/// Advice on a file that is no map, by its extension, behind "; ": one of a CAD program is
/// exported, a compressed one unpacked. Empty for others.
std::string advice_on_no_map(const std::filesystem::path& file);

}  // namespace microswarm::formats
