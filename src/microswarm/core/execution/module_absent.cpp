// SPDX-License-Identifier: Apache-2.0
// The build without an operating system that loads modules.
#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/execution/module.hpp"

namespace microswarm {

void* load_module(const std::string& name, const std::string& users) {
  throw InputError("libmicroswarm_" + name + ".so",
                   "is not in this build, and " + users + " need it: use the installed program");
}

}  // namespace microswarm
