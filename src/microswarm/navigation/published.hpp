// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/format.h>

#include "microswarm/core/places.hpp"

namespace microswarm {

/// For a navigator with `as_published`: throws InputError when a key of ours is given a value that
/// is neither the default nor the paper's, since it would have no effect.
template <class T>
void check_published(const Places& where, const char* key, T given, T usual, T published) {
  if (given != usual && given != published)
    throw where.error(key, fmt::format("{} is not the paper's, and as_published is true", key));
}

}  // namespace microswarm
