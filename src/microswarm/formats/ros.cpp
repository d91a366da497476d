// SPDX-License-Identifier: Apache-2.0
#include "microswarm/formats/ros.hpp"

#include "microswarm/config/yaml.hpp"
#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/text/text.hpp"

namespace microswarm {
namespace {

/// Occupancy of a cell from its pixel value [0, 255].
enum class Cell { free, unknown, occupied };

Cell cell_of(double value, const RosHeader& header) {
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
  if (header.free_thresh > header.occupied_thresh)
    fail("free_thresh " + number_text(header.free_thresh) + " is above occupied_thresh " +
         number_text(header.occupied_thresh));
  return header;
}

RosHeader read_ros_header(const std::filesystem::path& path) {
  return parse_ros_header(read_file(path, max_yaml_bytes), path.string());
}

Mask ros_walls(const Image& image, const RosHeader& header, bool unknown_free) {
  Mask mask(image.width, image.height);
  const auto channels = static_cast<std::size_t>(image.channels);
  for (std::size_t i = 0; i < mask.cells.size(); ++i) {
    int sum = 0;  // mean of the colours, as in map_server
    for (std::size_t c = 0; c < channels; ++c) sum += image.pixels[i * channels + c];
    const Cell cell = cell_of(static_cast<double>(sum) / image.channels, header);
    mask.cells[i] = cell == Cell::occupied || (cell == Cell::unknown && !unknown_free);
  }
  return mask;
}

std::string ros_header_text(const RosHeader& header) {
  return "image: " + header.image + "\nmode: " + std::string(enum_name(header.mode)) +
         "\nresolution: " + number_text(header.resolution) + "\norigin: [" +
         number_text(header.origin[0]) + ", " + number_text(header.origin[1]) + ", " +
         number_text(header.origin[2]) + "]\nnegate: " + std::to_string(header.negate) +
         "\noccupied_thresh: " + number_text(header.occupied_thresh) +
         "\nfree_thresh: " + number_text(header.free_thresh) + "\n";
}

}  // namespace microswarm
