// SPDX-License-Identifier: Apache-2.0
#include "microswarm/formats/images/tiff_description.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <pugixml.hpp>

#include "microswarm/core/text/lines.hpp"
#include "microswarm/core/text/text.hpp"
#include "microswarm/core/text/unit_names.hpp"

namespace microswarm::formats {
namespace {

constexpr int max_images = 1'000'000;

std::optional<double> positive(std::string_view text, double unit) {
  const std::optional<double> value = parse_number(trimmed(text));
  if (!value || !(*value * unit > 0) || !std::isfinite(*value * unit)) return std::nullopt;
  return *value * unit;
}

/// A count of 1 to max_images; 1 for anything else.
int count_in(std::string_view text) {
  int value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size() && value <= max_images
             ? std::max(value, 1)
             : 1;
}

/// Value of a line `key=value`; empty without.
std::string_view value_of(std::string_view text, std::string_view key) {
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string_view line = trimmed(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
    if (line.size() > key.size() && line.starts_with(key) && line[key.size()] == '=')
      return line.substr(key.size() + 1);
  }
  return {};
}

TiffDescription of_imagej(std::string_view text, double x_resolution, double y_resolution) {
  TiffDescription d{.software = "ImageJ"};
  d.images = count_in(value_of(text, "images"));
  d.channels = count_in(value_of(text, "channels"));
  d.slices = count_in(value_of(text, "slices"));
  const std::string_view frames = value_of(text, "frames");
  const double in_a_time = static_cast<double>(d.channels) * d.slices;
  d.times =
      frames.empty() ? static_cast<int>(std::max(1.0, d.images / in_a_time)) : count_in(frames);
  const std::string_view y_unit = value_of(text, "yunit");
  const auto length = length_unit_um(value_of(text, "unit"));
  const auto y_length = y_unit.empty() ? length : length_unit_um(y_unit);
  if (length && x_resolution > 0) d.um_per_px = *length / x_resolution;
  if (y_length && y_resolution > 0) d.um_per_px_y = *y_length / y_resolution;
  const std::string_view time_unit = value_of(text, "tunit");
  const auto seconds = time_unit.empty() ? std::optional(1.0) : time_unit_s(time_unit);
  if (seconds) d.interval = positive(value_of(text, "finterval"), *seconds);
  return d;
}

/// A quantity of an element: its attribute times the unit that NAMEUnit names.
std::optional<double> quantity(const pugi::xml_node& node, const std::string& name,
                               std::optional<double> (*unit_size)(std::string_view),
                               std::string_view usual_unit) {
  const std::string_view unit = node.attribute((name + "Unit").c_str()).as_string();
  const auto size = unit_size(unit.empty() ? usual_unit : unit);
  const std::string_view text = node.attribute(name.c_str()).as_string();
  if (!size || text.empty()) return std::nullopt;
  const auto value = parse_number(text);
  if (!value) return std::nullopt;
  return *value * *size;
}

/// Times of the pages by the elements Plane, in the order of pages.
std::vector<std::optional<double>> plane_times(const pugi::xml_node& pixels,
                                               const TiffDescription& d) {
  std::vector<std::optional<double>> times(static_cast<std::size_t>(d.images));
  bool any = false;
  for (const pugi::xml_node& plane : pixels.children("Plane")) {
    int page = 0, stride = 1;
    for (const char axis : d.order) {
      const int size = axis == 'C' ? d.channels : axis == 'Z' ? d.slices : d.times;
      const int at = plane.attribute((std::string("The") + axis).c_str()).as_int(-1);
      if (at < 0 || at >= size) return {};
      page += at * stride;
      stride *= size;
    }
    times[static_cast<std::size_t>(page)] = quantity(plane, "DeltaT", time_unit_s, "s");
    any = any || times[static_cast<std::size_t>(page)];
  }
  if (!any) times.clear();
  return times;
}

TiffDescription of_ome(std::string_view text) {
  pugi::xml_document document;
  if (!document.load_buffer(text.data(), text.size())) return {};
  const pugi::xml_node pixels = document.child("OME").child("Image").child("Pixels");
  if (!pixels) return {};
  TiffDescription d{.software = "OME"};
  const auto size = [&](const char* name) { return count_in(pixels.attribute(name).as_string()); };
  const int in_pixel = count_in(pixels.child("Channel").attribute("SamplesPerPixel").as_string());
  d.channels = std::max(1, size("SizeC") / in_pixel);
  d.slices = size("SizeZ");
  d.times = size("SizeT");
  const double images = static_cast<double>(d.channels) * d.slices * d.times;
  if (images > max_images) return {};
  d.images = static_cast<int>(images);
  const std::string order = pixels.attribute("DimensionOrder").as_string("XYCZT");
  if (order.size() == 5 && order.starts_with("XY") &&
      std::ranges::all_of(d.order, [&](char axis) { return order.find(axis) != order.npos; }))
    d.order = order.substr(2);
  const auto above_0 = [](std::optional<double> v) { return v && *v > 0 ? v : std::nullopt; };
  d.um_per_px = above_0(quantity(pixels, "PhysicalSizeX", length_unit_um, "µm"));
  d.um_per_px_y = above_0(quantity(pixels, "PhysicalSizeY", length_unit_um, "µm"));
  d.interval = above_0(quantity(pixels, "TimeIncrement", time_unit_s, "s"));
  d.page_times = plane_times(pixels, d);
  return d;
}

}  // namespace

TiffDescription parse_tiff_description(std::string_view text, double x_resolution,
                                       double y_resolution) {
  if (text.starts_with("ImageJ=")) return of_imagej(text, x_resolution, y_resolution);
  if (text.find("<OME") != text.npos) return of_ome(text);
  return {};
}

}  // namespace microswarm::formats
