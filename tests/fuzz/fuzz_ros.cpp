// SPDX-License-Identifier: Apache-2.0
// Headers of ROS maps: one that is read writes and reads back, and gives walls.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/formats/ros.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace microswarm;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  try {
    const formats::RosHeader header = formats::parse_ros_header(text, "fuzz.yaml");
    const std::string written = formats::ros_header_text(header);
    if (formats::ros_header_text(formats::parse_ros_header(written, "again.yaml")) != written)
      std::abort();
    formats::ros_walls({4, 1, 1, {0, 205, 254, 100}}, header);
  } catch (const InputError&) {
  }
  return 0;
}
