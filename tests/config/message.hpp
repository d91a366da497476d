// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "microswarm/core/errors/error.hpp"

namespace microswarm::sample {

/// The message of the InputError that `f` throws.
template <class F>
std::string message_of(F&& f) {
  try {
    f();
  } catch (const InputError& error) {
    return error.what();
  }
  return "nothing was thrown";
}

}  // namespace microswarm::sample
