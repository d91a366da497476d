// SPDX-License-Identifier: Apache-2.0
// Grids of measured fields, as text and as YAML: what is read has a finite field in its middle.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "microswarm/actuation/coils/vfield.hpp"
#include "microswarm/core/errors/error.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace microswarm;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  for (auto* parse : {actuation::parse_vfield_text, actuation::parse_vfield_yaml}) {
    try {
      const actuation::FieldGrid grid = parse(text, "fuzz");
      const Eigen::Vector3d middle = 0.5 * (grid.lo() + grid.hi());
      if (!grid.contains(middle) || !grid.at(middle).field.allFinite()) std::abort();
      for (const Eigen::Vector3d& end : {grid.lo(), grid.hi()})
        if (!grid.at(end).field.allFinite()) std::abort();
    } catch (const InputError& error) {
      if (std::string_view(error.what()).find('\n') != std::string_view::npos) std::abort();
    }
  }
  return 0;
}
