// SPDX-License-Identifier: Apache-2.0
#include "microswarm/core/text/durable_rename.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cstdio>

#include "microswarm/core/execution/descriptor.hpp"

namespace microswarm {

bool rename_durably(const std::filesystem::path& from, const std::filesystem::path& to) {
  if (::rename(from.c_str(), to.c_str()) != 0) return false;
  // Some file systems cannot flush a folder; the file has its name nevertheless.
  const std::filesystem::path folder = to.has_parent_path() ? to.parent_path() : ".";
  if (const Descriptor at = open_descriptor(folder, O_RDONLY | O_DIRECTORY)) ::fsync(at.get());
  return true;
}

}  // namespace microswarm
