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
    const formats::MapParts parts = formats::parse_geojson(text, "fuzz.geojson");
    formats::check(parts, "fuzz.geojson");
    const formats::MapParts again =
        formats::parse_geojson(formats::geojson_text(parts), "again.geojson");
    if (formats::fingerprint(again) != formats::fingerprint(parts)) std::abort();
  } catch (const InputError& error) {
    if (std::string_view(error.what()).find('\n') != std::string_view::npos) std::abort();
  }
  return 0;
}
