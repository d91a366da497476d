// SPDX-License-Identifier: Apache-2.0
#include "microswarm/core/execution/descriptor.hpp"

#include <fcntl.h>
#include <unistd.h>

namespace microswarm {

bool Descriptor::close() { return file_ < 0 || ::close(std::exchange(file_, -1)) == 0; }

Descriptor open_descriptor(const std::filesystem::path& path, int flags) {
  return Descriptor(::open(path.c_str(), flags | O_CLOEXEC, 0666));
}

}  // namespace microswarm
