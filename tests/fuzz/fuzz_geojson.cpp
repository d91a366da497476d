// SPDX-License-Identifier: Apache-2.0
// GeoJSON: whatever is read is finite, and writes and reads back to the same bits.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/formats/geojson.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace microswarm;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  try {
    const MapParts parts = parse_geojson(text, "fuzz.geojson");
    check(parts, "fuzz.geojson");
    const MapParts again = parse_geojson(geojson_text(parts), "again.geojson");
    if (fingerprint(again) != fingerprint(parts)) std::abort();
  } catch (const InputError& error) {
    if (std::string_view(error.what()).find('\n') != std::string_view::npos) std::abort();
  }
  return 0;
}
