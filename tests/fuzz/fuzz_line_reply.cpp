// SPDX-License-Identifier: Apache-2.0
// Whatever a driver of one's own says is a reply, safe to use and to print, or is passed over.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "microswarm/actuation/drivers/line_protocol.hpp"
#include "microswarm/core/text/text.hpp"

namespace {

void require(bool holds) {
  if (!holds) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace microswarm;
  actuation::LineReader reader;
  for (std::size_t k = 0; k < size; ++k) {
    const auto line = reader.take(data[k]);
    if (!line) continue;
    require(line->size() <= actuation::line_protocol_length);
    const auto reply = actuation::parse_line_reply(*line);
    if (!reply) continue;
    require(reply->values.size() <= actuation::line_protocol_values);
    require(std::ranges::all_of(reply->values, [](double value) { return std::isfinite(value); }));
    require(reply->temperatures.size() <= actuation::line_protocol_values);
    require(std::ranges::none_of(reply->temperatures, [](double t) { return std::isinf(t); }));
    require(reply->text == one_line(reply->text, 1000));
  }
  return 0;
}
