// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace microswarm {

/// A module is a part of microswarm that brings many shared libraries, which would be loaded at
/// every start; it is loaded at the first use instead, and stays until the program ends. Loads
/// libmicroswarm_NAME.so of this version and returns the address of its C function microswarm_NAME.
/// It is looked for in the folder that the environment variable MICROSWARM_MODULES names, in
/// lib/microswarm as seen from the library that this is in, then from the program, then where the
/// system looks (the run path, which microswarmConfig.cmake and the .pc files set;
/// LD_LIBRARY_PATH), then where this build and the Debian package are installed. `users` says what
/// needs it: throws InputError "libmicroswarm_NAME.so: cannot be loaded, and USERS need it: WHY".
void* load_module(const std::string& name, const std::string& users);

}  // namespace microswarm
