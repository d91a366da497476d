// SPDX-License-Identifier: Apache-2.0
// Tables of pictures' times: what is read ascends.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <functional>
#include <string_view>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/vision/camera/frame_times.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace microswarm;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  try {
    const std::vector<double> times = vision::parse_frame_times(text, "fuzz.csv");
    if (times.empty() || !std::is_sorted(times.begin(), times.end(), std::less_equal<>()))
      std::abort();
  } catch (const InputError& error) {
    if (std::string_view(error.what()).find('\n') != std::string_view::npos) std::abort();
  }
  return 0;
}
