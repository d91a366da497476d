// SPDX-License-Identifier: Apache-2.0
// CSV of measured fields: what is read has a current for every coil, and a fit is finite.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "microswarm/actuation/coils/calibration.hpp"
#include "microswarm/core/errors/error.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace microswarm;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  try {
    const actuation::FieldMeasurements measured = actuation::parse_measurements(text, "fuzz.csv");
    if (measured.rows.empty()) std::abort();
    for (const actuation::FieldMeasurement& row : measured.rows)
      if (static_cast<std::size_t>(row.currents.size()) != measured.coils.size()) std::abort();
    const actuation::FittedMatrix fit = actuation::fit_matrix(measured, {.offset = true});
    if (fit.residuals.size() != measured.rows.size() || !std::isfinite(fit.total_rms)) std::abort();
    const actuation::FittedMatrix local =
        actuation::fit_matrix(measured, {.offset = true, .gradients = true});
    if (!std::isfinite(local.total_rms)) std::abort();
  } catch (const InputError& error) {
    if (std::string_view(error.what()).find('\n') != std::string_view::npos) std::abort();
  }
  return 0;
}
