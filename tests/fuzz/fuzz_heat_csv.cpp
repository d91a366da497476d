// SPDX-License-Identifier: Apache-2.0
// CSV of a coil's heat: what is read has its rows in the order of time, and a fit is finite.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "microswarm/actuation/coils/heat_fit.hpp"
#include "microswarm/core/errors/error.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace microswarm;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  try {
    const actuation::HeatLog log = actuation::parse_heat_log(text, "fuzz.csv");
    for (std::size_t k = 1; k < log.rows.size(); ++k)
      if (log.rows[k].t < log.rows[k - 1].t) std::abort();
    const actuation::HeatFit fit = actuation::fit_heat(log, {});
    if (!std::isfinite(fit.thermal_resistance.value) || !std::isfinite(fit.thermal_time.value) ||
        !std::isfinite(fit.rms))
      std::abort();
  } catch (const InputError& error) {
    if (std::string_view(error.what()).find('\n') != std::string_view::npos) std::abort();
  }
  return 0;
}
