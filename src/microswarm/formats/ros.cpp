// SPDX-License-Identifier: Apache-2.0
#include "microswarm/formats/ros.hpp"

#include <algorithm>

#include "microswarm/config/value_reader.hpp"
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

constexpr std::uint8_t saver_unknown = 205, saver_free = 254;
constexpr double usual_free_thresh = 0.196;

/// Grey of a pixel: the mean of the colours, as in map_server.
double mean_grey(const Image& image, std::size_t pixel) {
  const auto channels = static_cast<std::size_t>(image.channels);
  int sum = 0;
  for (std::size_t c = 0; c < channels; ++c) sum += image.pixels[pixel * channels + c];
  return static_cast<double>(sum) / image.channels;
}

std::string lower_case(std::string text) {
  for (char& c : text) c = static_cast<char>(c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c);
  return text;
}

bool is_no_number(const YamlNode& node) {
  std::string text = lower_case(node.text);
  std::erase_if(text, [](char c) { return c == '-' || c == '+' || c == '.'; });
  return node.kind == YamlNode::Kind::scalar && text == "nan";
}

/// Brings what nav2 reads into the form that a header is read from.
void accept_nav2_forms(YamlNode& document, std::string_view name, RosHeader& header) {
  const Type& type = type_of<RosHeader>();
  std::vector<std::string_view> known;
  for (const Field& field : type.fields) known.push_back(field.key);
  std::vector<YamlNode> kept;
  for (std::size_t i = 0; i + 1 < document.items.size(); i += 2) {
    const YamlNode& key = document.items[i];
    YamlNode& value = document.items[i + 1];
    if (!type.field(key.text) && nearest_word(key.text, known).empty()) {
      header.unread.push_back(key.text);
      continue;
    }
    const std::string word = lower_case(value.text);
    if (key.text == "mode") value.text = word;
    if (key.text == "negate" && (word == "true" || word == "yes" || word == "on")) value.text = "1";
    if (key.text == "negate" && (word == "false" || word == "no" || word == "off"))
      value.text = "0";
    if (key.text == "origin" && value.items.size() == 3 && is_no_number(value.items[2]))
      throw InputError(std::string(name), value.items[2].line, value.items[2].column,
                       "the yaw of origin is " + value.items[2].text +
                           ", as octomap's savers write it: write 0 for a map that is not turned");
    kept.push_back(key);
    kept.push_back(std::move(value));
  }
  if (document.kind == YamlNode::Kind::map) document.items = std::move(kept);
}

}  // namespace

RosHeader parse_ros_header(std::string_view text, std::string_view name) {
  RosHeader header;
  YamlNode document = parse_yaml(text, name);
  if (document.line == 0) document.line = document.column = 1;  // an empty one
  accept_nav2_forms(document, name, header);
  ValueReader reader(name, true);
  reader.read(type_of<RosHeader>(), {}, "", &header, document);
  if (!reader.issues().empty()) throw InputError(reader.issues());
  const auto fail = [&](const std::string& why) { throw InputError(std::string(name), why); };
  if (header.origin.size() != 3)
    fail("origin of " + std::to_string(header.origin.size()) + " numbers, 3 expected: x, y, yaw");
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

SaverUnknown find_saver_unknown(const Image& image, const RosHeader& header) {
  SaverUnknown found;
  const bool is_lost = to_cell(saver_unknown, header) == Cell::free;
  if (header.mode != RosMode::trinary || header.negate != 0 || !is_lost) return found;
  RosHeader usual = header;
  usual.free_thresh = usual_free_thresh;
  bool has_free = false, has_others = false;
  const std::size_t pixels =
      static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
  for (std::size_t i = 0; i < pixels; ++i) {
    const double value = mean_grey(image, i);
    if (to_cell(value, header) == Cell::free && to_cell(value, usual) != Cell::free) ++found.lost;
    if (value == saver_unknown)
      ++found.cells;
    else if (value == saver_free || value == 255)
      has_free = true;
    else if (value != 0)
      has_others = true;
  }
  found.is_of_map_saver = found.cells > 0 && has_free && !has_others;
  return found;
}

Mask ros_walls(const Image& image, const RosHeader& header, bool unknown_free,
               std::span<const std::uint8_t> transparent) {
  Mask mask(image.width, image.height);
  const bool saver = find_saver_unknown(image, header).is_of_map_saver;
  for (std::size_t i = 0; i < mask.cells.size(); ++i) {
    const double value = mean_grey(image, i);
    const bool is_there = transparent.empty() || transparent[i] == 0;
    const bool is_known = is_there && !(saver && value == saver_unknown);
    const Cell cell = is_known ? to_cell(value, header) : Cell::unknown;
    mask.cells[i] = cell == Cell::occupied || (cell == Cell::unknown && !unknown_free);
  }
  return mask;
}

std::string ros_header_text(const RosHeader& header) { return to_yaml(header); }

}  // namespace microswarm::formats
