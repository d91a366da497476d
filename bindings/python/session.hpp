// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "calls.hpp"
#include "microswarm/experiment/session/session.hpp"

namespace microswarm::python {

/// An open session as an object of the class Session.
py::object session_object(std::unique_ptr<experiment::Session> session);

}  // namespace microswarm::python
