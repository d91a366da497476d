// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "microswarm/core/fields.hpp"

namespace microswarm {

/// The finite number that all of `text` spells, to more digits than a double holds.
std::optional<long double> exact_number(std::string_view text);

/// The stored value of a number as it stands in a file: degrees become rad, all else is as it is.
/// Nothing when `text` is no finite decimal number.
std::optional<double> stored_number(std::string_view text, Unit unit);

/// Shortest text that `stored_number` reads back to the same bits; "nan", "inf", "-inf" for those.
std::string shown_number(double stored, Unit unit);

/// "1..1e5 µm", "at least 0 s", "at most 1"; empty when everything is allowed.
std::string range_text(const Range& range, Unit unit);

/// " µm", or nothing for a number without a unit.
std::string spaced_symbol(Unit unit);

}  // namespace microswarm
