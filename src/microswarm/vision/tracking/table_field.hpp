// SPDX-License-Identifier: Apache-2.0
// Fields of the tables of other programs, and their ranges.
#pragma once

#include <cmath>
#include <optional>
#include <string>
#include <string_view>

#include "microswarm/core/text/text.hpp"

namespace microswarm::vision {

constexpr double max_table_frame = 1e7;
constexpr double max_table_id = 1e6;
constexpr double max_table_position = 1e7;  // [px or µm]

/// Whether a unit of positions is the pixel.
inline bool is_pixel_unit(std::string_view unit) {
  return unit == "pixel" || unit == "pixels" || unit == "px";
}

/// Number `text` of a field `name` in [least, most]; `fail(WHY)` throws if it is none.
template <class Fail>
double field_number(std::string_view text, std::string_view name, double least, double most,
                    const Fail& fail) {
  const std::optional<double> value = parse_number(text);
  if (!value) fail(std::string(name) + " " + quote(text) + " is no number");
  if (!(*value >= least && *value <= most))
    fail(std::string(name) + " is " + number_text(*value) + ", must be " + number_text(least) +
         " to " + number_text(most));
  return *value;
}

/// The same for a whole number from 0.
template <class Fail>
int field_whole(std::string_view text, std::string_view name, double most, const Fail& fail) {
  const double value = field_number(text, name, 0, most, fail);
  if (value != std::floor(value))
    fail(std::string(name) + " is " + number_text(value) + ", must be a whole number");
  return static_cast<int>(value);
}

}  // namespace microswarm::vision
