// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "microswarm/geometry/shapes.hpp"

namespace microswarm {

/// Two solids that share a point, by their indices; discs count on after the polygons.
struct Contact {
  std::size_t first;
  std::size_t second;
  /// Do they share more than single points? Told for polygons only.
  bool overlap;
};

/// Which polygons and discs touch or overlap. Exact, apart from the rounding of a disc's rim. A
/// polygon whose ring crosses itself is in overlap with itself. Every connected group of solids is
/// connected by the contacts, though not every pair in it need be listed.
std::vector<Contact> find_contacts(std::span<const Polygon> polygons, std::span<const Disc> discs);

}  // namespace microswarm
