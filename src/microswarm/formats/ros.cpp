// SPDX-License-Identifier: Apache-2.0
#include "microswarm/formats/ros.hpp"

#include "microswarm/config/write.hpp"
#include "microswarm/config/yaml.hpp"
#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/text/text.hpp"

namespace microswarm::formats {
namespace {

/// Occupancy of a cell from its pixel value [0, 255].
enum class Cell { free, unknown, occupied };

Cell to_cell(double value, const RosHeader& header) {
  double probability = header.negate ? value / 255 : (255 - value) / 255;
  if (header.mode == RosMode::raw) {
    if (value > 100) return Cell::unknown;
    probability = value / 100;
  }
  if (probability > header.occupied_thresh) return Cell::occupied;
  return probability < header.free_thresh ? Cell::free : Cell::unknown;
}

}  // namespace

RosHeader parse_ros_header(std::string_view text, std::string_view name) {
  RosHeader header = read_yaml_text<RosHeader>(text, name);
  const auto fail = [&](const std::string& why) {
    throw InputError(std::string(name) + ": " + why);
  };
  if (header.origin.size() != 3)
    fail("origin of " + std::to_string(header.origin.size()) + " numbers, 3 expected: x, y, yaw");
  if (header.origin[2] != 0)
    fail("origin with yaw " + number_text(header.origin[2]) + " rad: only 0 is read");
  if (header.mode == RosMode::raw && header.negate != 0)
    fail("negate is 1 in the mode raw, must be 0: ROS 1 and ROS 2 read that differently");
  if (header.free_thresh > header.occupied_thresh)
    fail("free_thresh " + number_text(header.free_thresh) + " is above occupied_thresh " +
         number_text(header.occupied_thresh));
  return header;
}

RosHeader read_ros_header(const std::filesystem::path& path) {
  return parse_ros_header(read_file(path, max_yaml_bytes), path.string());
}

Mask ros_walls(const Image& image, const RosHeader& header, bool unknown_free,
               std::span<const std::uint8_t> transparent) {
  Mask mask(image.width, image.height);
  const auto channels = static_cast<std::size_t>(image.channels);
  for (std::size_t i = 0; i < mask.cells.size(); ++i) {
    int sum = 0;  // mean of the colours, as in map_server
    for (std::size_t c = 0; c < channels; ++c) sum += image.pixels[i * channels + c];
    const bool is_there = transparent.empty() || transparent[i] == 0;
    const Cell cell =
        is_there ? to_cell(static_cast<double>(sum) / image.channels, header) : Cell::unknown;
    mask.cells[i] = cell == Cell::occupied || (cell == Cell::unknown && !unknown_free);
  }
  return mask;
}

std::string ros_header_text(const RosHeader& header) { return to_yaml(header); }

}  // namespace microswarm::formats
