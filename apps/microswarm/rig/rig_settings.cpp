// SPDX-License-Identifier: Apache-2.0
#include "rig/rig_settings.hpp"

#include "microswarm/rig/params/rig_params.hpp"
#include "support/options.hpp"

namespace microswarm::cli {

Option add_rig_settings(Command command, const char* name, std::vector<std::string>& values) {
  return command.add_option(name, values, "Override a rig value")
      .type_name("KEY=VALUE")
      .repeatable()
      .suggest(suggest_settings(type_of<rig::RigParams>));
}

}  // namespace microswarm::cli
