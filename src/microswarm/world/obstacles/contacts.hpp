// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "microswarm/geometry/shapes.hpp"

namespace microswarm {

/// Two solids that share a point, by index; disc indices follow those of the polygons.
struct Contact {
  std::size_t first = 0;
  std::size_t second = 0;
  /// Whether they share more than single points. Determined for polygons only.
  bool overlap = false;
};

/// Contacts and overlaps of polygons and discs. Exact apart from the rounding of a disc's rim. A
/// self-intersecting polygon overlaps itself. Every connected group of solids is connected by the
/// contacts, but not every pair in it is listed. Throws InputError for edges that meet too often.
std::vector<Contact> find_contacts(std::span<const Polygon> polygons, std::span<const Disc> discs);

}  // namespace microswarm
