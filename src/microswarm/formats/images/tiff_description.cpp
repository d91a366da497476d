// SPDX-License-Identifier: Apache-2.0
#include "microswarm/formats/images/tiff_description.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <nlohmann/json.hpp>

#include "microswarm/core/text/lines.hpp"
#include "microswarm/core/text/text.hpp"
#include "microswarm/core/text/unit_names.hpp"
#include "microswarm/formats/images/tiff_ome.hpp"

namespace microswarm::formats {
namespace {

std::optional<double> positive(std::string_view text, double unit) {
  const std::optional<double> value = parse_number(trimmed(text));
  if (!value || !(*value * unit > 0) || !std::isfinite(*value * unit)) return std::nullopt;
  return *value * unit;
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
  d.one_directory = true;
  d.images = count_in_text(value_of(text, "images"));
  d.channels = count_in_text(value_of(text, "channels"));
  d.slices = count_in_text(value_of(text, "slices"));
  const std::string_view frames = value_of(text, "frames");
  const double in_a_time = static_cast<double>(d.channels) * d.slices;
  d.times = frames.empty() ? static_cast<int>(std::max(1.0, d.images / in_a_time))
                           : count_in_text(frames);
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

/// Items of a list that commas separate.
std::vector<std::string_view> items_of(std::string_view list) {
  std::vector<std::string_view> items;
  while (!list.empty()) {
    const std::size_t end = std::min(list.find(','), list.size());
    items.push_back(trimmed(list.substr(0, end)));
    list.remove_prefix(std::min(end + 1, list.size()));
  }
  return items;
}

/// Axes of a stack.
struct NamedAxes {
  std::string names;       ///< C, Z, T, or '?' of any other; the first changes fastest
  std::vector<int> sizes;  ///< of each
};

/// Takes axes that are longer than one picture.
void take_axes(const NamedAxes& axes, TiffDescription& d) {
  std::string order, others;
  double images = 1;
  TiffDescription told;
  for (std::size_t k = 0; k < axes.names.size(); ++k) {
    const int size = axes.sizes[k];
    const char axis = axes.names[k];
    images *= size;
    if (axis == '?' || order.find(axis) != order.npos) {
      others += size > 1 ? "?" : "";
      continue;
    }
    order += axis;
    (axis == 'C' ? told.channels : axis == 'Z' ? told.slices : told.times) = size;
  }
  if (images > max_tiff_images) return;
  if (!others.empty()) {
    d.notes.push_back(
        fmt::format("{} states {:.0f} pictures along axes that are not all times, channels or "
                    "slices: the pages are "
                    "taken as times",
                    d.software, images));
    return;
  }
  for (const char axis : std::string_view("CZT"))
    if (order.find(axis) == order.npos) order += axis;
  d.order = order;
  d.channels = told.channels;
  d.slices = told.slices;
  d.times = told.times;
  d.images = static_cast<int>(images);
}

/// SCIFIO writes ImageJ's keys; without them its axes and their lengths say the same.
TiffDescription of_scifio(std::string_view text, double x_resolution, double y_resolution) {
  TiffDescription d = of_imagej(text, x_resolution, y_resolution);
  d.software = "SCIFIO";
  const auto axes = items_of(value_of(text, "axes")), lengths = items_of(value_of(text, "lengths"));
  const auto scales = items_of(value_of(text, "scales")), units = items_of(value_of(text, "units"));
  if (axes.size() != lengths.size()) return d;
  NamedAxes named;
  for (std::size_t k = 0; k < axes.size(); ++k) {
    const bool has_scale = k < scales.size() && k < units.size();
    if (axes[k] == "X" || axes[k] == "Y") {
      const auto length = has_scale ? length_unit_um(units[k]) : std::nullopt;
      auto& side = axes[k] == "X" ? d.um_per_px : d.um_per_px_y;
      if (length && !side) side = positive(scales[k], *length);
      continue;
    }
    named.names += axes[k] == "Channel" ? 'C'
                   : axes[k] == "Z"     ? 'Z'
                   : axes[k] == "Time"  ? 'T'
                                        : '?';
    named.sizes.push_back(count_in_text(lengths[k]));
    if (const auto unit = has_scale && axes[k] == "Time" ? time_unit_s(units[k]) : std::nullopt;
        unit && !d.interval)
      d.interval = positive(scales[k], *unit);
  }
  if (!named.names.empty()) take_axes(named, d);
  return d;
}

/// tifffile writes the shape of an array, whose last axis changes fastest, and perhaps its axes.
/// An axis of `samples` entries, last or before the rows, is that of a pixel's samples.
TiffDescription of_tifffile(std::string_view text, int samples) {
  const auto json = nlohmann::json::parse(text, nullptr, false);
  if (!json.is_object() || !json.contains("shape") || !json["shape"].is_array()) return {};
  TiffDescription d{.software = "tifffile"};
  std::vector<int> shape;
  for (const auto& size : json["shape"]) {
    if (!size.is_number_integer() || size < 1 || size > max_tiff_images) return {};
    shape.push_back(size.get<int>());
  }
  const auto axes = json.find("axes");
  const bool named = axes != json.end() && axes->is_string();
  const std::string names = named ? axes->get<std::string>() : std::string();
  if (const auto cut = json.find("truncated"); cut != json.end() && cut->is_boolean())
    d.one_directory = cut->get<bool>();
  if (names.size() != shape.size()) {
    // Without names the last two axes, or three of colours, are those of a picture.
    const bool in_pixel =
        shape.size() > 2 && samples > 1 && (shape.back() == samples || shape.end()[-3] == samples);
    const bool colours = shape.size() > 2 && (shape.back() == 3 || shape.back() == 4);
    const std::size_t in_picture = in_pixel || colours ? 3 : 2;
    const auto end = shape.end() - static_cast<std::ptrdiff_t>(std::min(in_picture, shape.size()));
    if (std::count_if(shape.begin(), end, [](int size) { return size > 1; }) > 1)
      d.notes.push_back(
          "tifffile states several axes without their names: if some are channels or slices, they "
          "are taken as times");
    else if (shape.begin() != end)
      d.images = d.times = *std::max_element(shape.begin(), end);
    return d;
  }
  const bool has_time = names.find('T') != names.npos;
  NamedAxes found;
  for (std::size_t k = names.size(); k-- > 0;) {
    const char name = names[k];
    if (name == 'X' || name == 'Y' || name == 'S') continue;
    if (name == 'C' && samples > 1 && shape[k] == samples) continue;
    const bool is_series = !has_time && (name == 'I' || name == 'Q');
    found.names += is_series ? 'T' : std::string_view("CZT").find(name) < 3 ? name : '?';
    found.sizes.push_back(shape[k]);
  }
  take_axes(found, d);
  return d;
}

}  // namespace

int count_in_text(std::string_view text) {
  int value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size() && value <= max_tiff_images
             ? std::max(value, 1)
             : 1;
}

TiffDescription parse_tiff_description(std::string_view text, double x_resolution,
                                       double y_resolution, std::string_view file_name,
                                       int samples) {
  if (text.starts_with("ImageJ=")) return of_imagej(text, x_resolution, y_resolution);
  if (text.starts_with("SCIFIO=")) return of_scifio(text, x_resolution, y_resolution);
  if (text.starts_with("{")) return of_tifffile(text, samples);
  if (is_ome(text)) return parse_ome(text, file_name);
  return {};
}

}  // namespace microswarm::formats
