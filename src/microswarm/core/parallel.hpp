// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>

namespace microswarm {

/// Calls `body(i)` once for each i of 0 … count−1, on `jobs` threads (0: one a core), the caller's
/// being one of them. Each thread takes the next i when it is done with its last. When a call
/// throws, no further one begins, and one of the exceptions comes out of here.
void for_each_index(std::size_t count, int jobs, const std::function<void(std::size_t)>& body);

}  // namespace microswarm
