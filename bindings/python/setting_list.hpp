// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <vector>

#include "microswarm/config/settings.hpp"

namespace microswarm::python {

/// Appends a setting to a list and removes the earlier ones that it supersedes: those of the same
/// key and, for a scalar or list, of keys within it. A variant's `type` precedes settings within
/// the variant. `is_same` returns whether a list gives the same values as the plain list with
/// `added` at its end.
std::vector<Setting> with_setting(const std::vector<Setting>& settings, const Setting& added,
                                  const std::function<bool(const std::vector<Setting>&)>& is_same);

}  // namespace microswarm::python
