// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace microswarm::python {

/// The list of KEY=VALUE with one more at its end, without those before that it makes pointless:
/// of the same key and, of a scalar or list, of what is within it. A variant's `type` comes before
/// what is set within the variant. `is_same` says whether a list gives the present values; the
/// plain list with `added` at its end does.
std::vector<std::string> with_setting(
    const std::vector<std::string>& settings, const std::string& added,
    const std::function<bool(const std::vector<std::string>&)>& is_same);

}  // namespace microswarm::python
