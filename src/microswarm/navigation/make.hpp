// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string_view>

#include "microswarm/contracts/navigator.hpp"
#include "microswarm/core/errors/issue.hpp"
#include "microswarm/core/maths/rng.hpp"
#include "microswarm/navigation/params.hpp"
#include "microswarm/navigation/steering/task.hpp"

namespace microswarm::navigation {

/// Why the navigator cannot perform the task; empty if it can.
std::string_view unsupported_reason(const NavigatorParams& params, const Task& task);

/// Reports parameters of the navigator that are inconsistent or do not fit this swarm or map.
Issues validate(const NavigatorParams& params, const Task& task, const Map& map,
                const IsGiven& is_given = {});

/// Creates the navigator with these parameters, which must support the task.
std::unique_ptr<Navigator> make_navigator(const NavigatorParams& params, const Task& task, Rng rng);

}  // namespace microswarm::navigation
