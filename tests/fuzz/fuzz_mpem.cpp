// SPDX-License-Identifier: Apache-2.0
// Calibrations of electromagnets: what is read has coils with sources of a direction of length 1.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "microswarm/actuation/coils/mpem.hpp"
#include "microswarm/core/errors/error.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace microswarm;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  try {
    const actuation::MpemSystem system = actuation::parse_mpem(text, "fuzz.yaml");
    if (system.coils.empty()) std::abort();
    for (const actuation::MpemCoil& coil : system.coils) {
      if (coil.sources.empty()) std::abort();
      for (const actuation::Multipole& source : coil.sources) {
        if (std::abs(source.direction.norm() - 1) > 1e-9) std::abort();
        if (source.A.empty() && source.B.empty()) std::abort();
      }
      actuation::field_at(coil.sources, {1, 2, 3});
    }
  } catch (const InputError& error) {
    if (std::string_view(error.what()).find('\n') != std::string_view::npos) std::abort();
  }
  return 0;
}
