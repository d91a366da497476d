// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace microswarm::report {

/// A text for elements and attributes of HTML. Characters that are not printable are replaced.
std::string html_text(std::string_view text);

}  // namespace microswarm::report
