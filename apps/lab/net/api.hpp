// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "lab/net/exchange.hpp"

namespace microswarm::lab {

/// Path to which files are uploaded, with their bytes as body.
inline constexpr std::string_view uploads_path = "/api/uploads";

/// Handles a request that has access, as in docs/reference/lab-protocol.md: its method and path
/// select the handler. Throws InputError for a request that its handler refuses.
void handle(Exchange& exchange);

}  // namespace microswarm::lab
