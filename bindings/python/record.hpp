// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "calls.hpp"
#include "microswarm/experiment/record/record.hpp"

namespace microswarm::python {

/// Status, metrics as JSON and times of the steps.
py::dict summary_of(const RunResult& result);

}  // namespace microswarm::python
