// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>

namespace microswarm {

/// Calls `body(i)` once for each i in 0 … count−1 on `jobs` threads (0: one per core), including
/// the caller's. Each thread takes the next i when it is free. If a call throws, no further call
/// starts and one of the exceptions is rethrown.
void for_each_index(std::size_t count, int jobs, const std::function<void(std::size_t)>& body);

}  // namespace microswarm
