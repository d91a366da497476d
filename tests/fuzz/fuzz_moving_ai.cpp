// SPDX-License-Identifier: Apache-2.0
// MovingAI maps and query lists; the first byte says which.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/formats/moving_ai.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace microswarm;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  try {
    if (text.starts_with('v')) {
      formats::parse_scenarios(text, "fuzz.scen");
      return 0;
    }
    const formats::Mask mask = formats::parse_moving_ai(text, "fuzz.map");
    if (formats::parse_moving_ai(formats::moving_ai_text(mask), "again.map") != mask) std::abort();
    formats::mask_walls(mask, 1);
  } catch (const InputError& error) {
    if (std::string_view(error.what()).find('\n') != std::string_view::npos) std::abort();
  }
  return 0;
}
