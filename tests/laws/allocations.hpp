// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

namespace microswarm::laws {

/// How often this program has called operator new by now.
std::size_t allocations();

}  // namespace microswarm::laws
