// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace microswarm::cli {

/// From now on the library's messages name an input, such as um_per_px, by the option of the
/// command that runs. `options` are its options, "--out" each.
void name_inputs_by_options(std::vector<std::string> options);

}  // namespace microswarm::cli
