// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "microswarm/core/errors/error.hpp"

namespace microswarm {

/// A file cannot be written: its disk is full, does not answer, or its rights do not allow it.
class WriteError : public InputError {
 public:
  using InputError::InputError;
};

}  // namespace microswarm
