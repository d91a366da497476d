// SPDX-License-Identifier: Apache-2.0
// Tables of trackpy and TrackMate, CSV and XML: what is read is sorted by frame, and all rows have
// ids or none.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/vision/tracking/track_table.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace microswarm;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  try {
    const auto rows = vision::parse_track_table(text, "fuzz.csv", 0.5).rows;
    if (rows.empty()) std::abort();
    for (std::size_t i = 1; i < rows.size(); ++i)
      if (rows[i].frame < rows[i - 1].frame || rows[i].id.has_value() != rows[0].id.has_value())
        std::abort();
  } catch (const InputError& error) {
    if (std::string_view(error.what()).find('\n') != std::string_view::npos) std::abort();
  }
  return 0;
}
