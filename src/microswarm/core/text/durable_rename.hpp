// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

namespace microswarm {

/// Renames a file, replacing one of the new name, and flushes the folder to the disk (fsync), so
/// that a power cut does not undo it. False, with errno, if it is not renamed.
bool rename_durably(const std::filesystem::path& from, const std::filesystem::path& to);

}  // namespace microswarm
