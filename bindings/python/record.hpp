// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "calls.hpp"
#include "microswarm/experiment/record/record.hpp"
#include "microswarm/io/tables.hpp"

namespace microswarm::python {

/// A column for every quantity of a list of rows. `positions` is the field of a list of positions.
py::dict columns_of_list(const io::ListRef<const void*>& list, const Field* positions = nullptr);

/// Dictionary of a navigator's diagnostics, or None.
py::object to_dict(const Diagnostics& diagnostics);

/// Dictionary of status, metrics as JSON and times of the steps.
py::dict to_dict(const experiment::RunResult& result);

}  // namespace microswarm::python
