// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <utility>

#include "microswarm/formats/map_spec.hpp"
#include "microswarm/world/snapshot.hpp"

namespace microswarm::python {

/// A map, its name in messages, and its source in a scenario's form.
struct NamedMap {
  Snapshot world;
  std::string name;
  formats::MapSpec spec;

  const Map& map() const { return world.map(); }
};

/// A map made from a caller's data.
inline NamedMap map_in_memory(Map map) {
  formats::PolygonsMap spec;
  spec.lo = map.bounds().lo;
  spec.hi = map.bounds().hi;
  return {Snapshot(std::make_shared<const Map>(std::move(map))), "map", spec};
}

}  // namespace microswarm::python
