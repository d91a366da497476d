// SPDX-License-Identifier: Apache-2.0
// Whatever comes over the serial line is a reply or is passed over.
#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "microswarm/actuation/drivers/coil_link.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  microswarm::actuation::CoilReplyReader reader;
  for (std::size_t k = 0; k < size; ++k) {
    const auto reply = reader.take(data[k]);
    if (!reply) continue;
    microswarm::actuation::CoilReplyReader again;
    bool read = false;
    for (const std::uint8_t byte : microswarm::actuation::encode(*reply))
      read = again.take(byte) || read;
    if (!read) std::abort();
  }
  return 0;
}
