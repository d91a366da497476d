// SPDX-License-Identifier: Apache-2.0
// CSV of moving bodies: what is read has one point a time, and times that ascend.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <functional>
#include <string_view>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/formats/tracks.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace microswarm;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  try {
    for (const auto& [id, samples] : formats::parse_tracks(text, "fuzz.csv")) {
      const auto& times = samples.times;
      if (times.empty() || times.size() != samples.points.size() || id.empty()) std::abort();
      if (!std::is_sorted(times.begin(), times.end(), std::less_equal<>())) std::abort();
    }
  } catch (const InputError& error) {
    if (std::string_view(error.what()).find('\n') != std::string_view::npos) std::abort();
  }
  return 0;
}
