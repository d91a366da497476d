// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "microswarm/core/fields/fields.hpp"

namespace microswarm {

/// Finite number spelled by the whole text, with more digits than a double holds.
std::optional<long double> exact_number(std::string_view text);

/// Stored value of a number in a file: degrees are converted to rad, anything else is unchanged.
/// Nothing if `text` is no finite decimal number.
std::optional<double> stored_number(std::string_view text, Unit unit);

/// Shortest text that `stored_number` reads back to the same bits; or "nan", "inf", "-inf".
std::string shown_number(double stored, Unit unit);

/// "1..1e5 µm", "at least 0 s", "at most 1"; empty if unbounded.
std::string range_text(const Range& range, Unit unit);

/// Symbol after a space, " µm"; empty for no unit.
std::string spaced_symbol(Unit unit);

}  // namespace microswarm
