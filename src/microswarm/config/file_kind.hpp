// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

namespace microswarm {

/// For a YAML file with mistakes: throws InputError, one line, if its keys are those of another
/// kind of file than was expected ("scenario", "sweep", "rig" or "queue"), "first.yaml: this is a
/// scenario, not a sweep: `microswarm run` takes it". Does nothing for a text that is no YAML.
void refuse_other_kind(std::string_view text, std::string_view name, std::string_view expected);

}  // namespace microswarm
