// SPDX-License-Identifier: Apache-2.0
#include "microswarm/core/text/unit_names.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace microswarm {
namespace {

/// A unit's name and its size.
using UnitSize = std::pair<std::string_view, double>;
constexpr std::array<UnitSize, 25> lengths_um{
    {{"µm", 1},           {"μm", 1},           {"um", 1},
     {"micron", 1},       {"microns", 1},      {"\\u00B5m", 1},
     {"\\u03BCm", 1},     {"micrometer", 1},   {"micrometre", 1},
     {"micrometers", 1},  {"nm", 1e-3},        {"Å", 1e-4},
     {"pm", 1e-6},        {"nanometer", 1e-3}, {"mm", 1e3},
     {"millimeter", 1e3}, {"millimetre", 1e3}, {"millimeters", 1e3},
     {"micrometres", 1},  {"nanometre", 1e-3}, {"nanometers", 1e-3},
     {"centimeter", 1e4}, {"cm", 1e4},         {"m", 1e6},
     {"\xB5m", 1}}};
constexpr std::array<UnitSize, 22> times_s{{{"s", 1},
                                            {"sec", 1},
                                            {"second", 1},
                                            {"seconds", 1},
                                            {"ms", 1e-3},
                                            {"msec", 1e-3},
                                            {"millisecond", 1e-3},
                                            {"µs", 1e-6},
                                            {"μs", 1e-6},
                                            {"us", 1e-6},
                                            {"min", 60},
                                            {"minute", 60},
                                            {"minutes", 60},
                                            {"mins", 60},
                                            {"milliseconds", 1e-3},
                                            {"microsecond", 1e-6},
                                            {"microseconds", 1e-6},
                                            {"secs", 1},
                                            {"hours", 3600},
                                            {"hr", 3600},
                                            {"h", 3600},
                                            {"hour", 3600}}};

template <std::size_t N>
std::optional<double> size_of_unit(const std::array<UnitSize, N>& units, std::string_view name) {
  const auto found = std::ranges::find(units, name, &UnitSize::first);
  if (found == units.end()) return std::nullopt;
  return found->second;
}

}  // namespace

std::optional<double> length_unit_um(std::string_view name) {
  return size_of_unit(lengths_um, name);
}

std::optional<double> time_unit_s(std::string_view name) { return size_of_unit(times_s, name); }

}  // namespace microswarm
