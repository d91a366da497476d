// SPDX-License-Identifier: Apache-2.0
#include "microswarm/formats/choose_map_spec.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <span>
#include <utility>
#include <vector>

#include "microswarm/config/yaml.hpp"
#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/errors/input_names.hpp"
#include "microswarm/core/fields/overloaded.hpp"
#include "microswarm/core/text/text.hpp"
#include "microswarm/formats/images/image.hpp"
#include "microswarm/formats/map_extension.hpp"
#include "microswarm/formats/map_file.hpp"
#include "microswarm/formats/matrix.hpp"
#include "microswarm/formats/ros.hpp"

namespace microswarm::formats {
namespace {

namespace fs = std::filesystem;

/// Name of a kind of map file, and the extensions of such files.
struct FileFormat {
  std::string_view name;
  std::span<const std::string_view> extensions;
};

/// The format of a kind of map; nothing for one without a file.
std::optional<FileFormat> file_format(const MapSpec& spec) {
  static constexpr std::array<std::string_view, 3> csv{".csv", ".txt", ".tsv"};
  static constexpr std::array<std::string_view, 2> ros{".yaml", ".yml"},
      geojson{".geojson", ".json"};
  static constexpr std::array<std::string_view, 1> moving_ai{".map"}, svg{".svg"};
  using Format = std::optional<FileFormat>;
  return std::visit(Overloaded{[](const OneOf<PolygonsMap, ChannelMap> auto&) { return Format(); },
                               [](const ImageMap&) {
                                 return Format({"picture", image_extensions});
                               },
                               [](const RosMap&) {
                                 return Format({"ROS .yaml", ros});
                               },
                               [](const MovingAiMap&) {
                                 return Format({"MovingAI .map", moving_ai});
                               },
                               [](const GeoJsonMap&) {
                                 return Format({"GeoJSON", geojson});
                               },
                               [](const SvgMap&) {
                                 return Format({"SVG", svg});
                               },
                               [](const MatrixMap&) {
                                 return Format({"matrix of 0 and 1", csv});
                               },
                               [](const RectanglesMap&) {
                                 return Format({"CSV of rectangles", csv});
                               }},
                    spec);
}

/// A map of each kind.
std::vector<MapSpec> every_kind() {
  return []<std::size_t... I>(std::index_sequence<I...>) {
    return std::vector<MapSpec>{std::variant_alternative_t<I, MapSpec>{}...};
  }
  (std::make_index_sequence<std::variant_size_v<MapSpec>>());
}

/// Whether the settings choose the type of the map.
bool chooses_type(const Settings& settings) {
  return std::ranges::any_of(
      settings.list, [](const Setting& s) { return s.key == "map.type" || s.key == "map"; });
}

/// Sets the scale of a map whose file and settings are set; `fail` throws.
template <class Fail>
void set_scale(MapSpec& spec, const MapChoice& choice, Fail&& fail) {
  const std::optional<double>&px = choice.um_per_px, &unit = choice.um_per_unit;
  const std::string px_name = input_name("um_per_px"), unit_name = input_name("um_per_unit");
  const auto is_set = [&](std::string_view key) {
    return std::ranges::any_of(choice.settings.list,
                               [&](const Setting& s) { return s.key == key; });
  };
  const auto need_one = [&](const auto& option, const std::string& name,
                            std::initializer_list<std::string_view> keys) {
    for (const std::string_view key : keys)
      if (option && is_set(key))
        fail("its scale is given twice: by " + name + " and by " + std::string(key));
  };
  need_one(px, px_name, {"map.um_per_px", "map.um_per_cell", "map.um_per_m"});
  need_one(unit, unit_name, {"map.um_per_unit", "map.um_per_m"});
  const auto need_no_unit = [&] {
    if (unit) fail("has no unit: leave out " + unit_name + ", give " + px_name);
  };
  const auto need_no_px = [&] {
    if (px) fail("has no pixels: leave out " + px_name + ", give " + unit_name);
  };
  std::visit(
      Overloaded{[&](ImageMap& s) {
                   need_no_unit();
                   if (!px && !is_set("map.um_per_px"))
                     fail("µm per px is missing: give " + px_name);
                   s.um_per_px = px.value_or(s.um_per_px);
                 },
                 [&](RosMap& s) {
                   const RosHeader header = read_ros_header(s.file);
                   if (px && unit) fail("give either " + px_name + " or " + unit_name);
                   if (px) s.um_per_m = *px / header.resolution;
                   if (unit) s.um_per_m = *unit;
                 },
                 [&](MovingAiMap& s) {
                   need_no_unit();
                   s.um_per_cell = px.value_or(s.um_per_cell);
                 },
                 [&](MatrixMap& s) {
                   need_no_unit();
                   if (!px && !is_set("map.um_per_cell"))
                     fail("a matrix of 0 and 1, whose cells' side is missing: give " + px_name);
                   s.um_per_cell = px.value_or(s.um_per_cell);
                 },
                 [&](SvgMap& s) {
                   if (px) s.um_per_px = px;
                   if (unit) s.um_per_unit = unit;
                 },
                 [&](GeoJsonMap& s) {
                   need_no_px();
                   if (unit) s.um_per_unit = unit;
                 },
                 [&](RectanglesMap& s) {
                   if (px && !chooses_type(choice.settings))
                     fail("is read as a table of rectangles, which has no pixels: give " +
                          unit_name + ", not " + px_name + "; a matrix has rows of 0 and 1 only");
                   need_no_px();
                   s.um_per_unit = unit.value_or(s.um_per_unit);
                 },
                 [&](const OneOf<PolygonsMap, ChannelMap> auto&) { fail("is no file of walls"); }},
      spec);
}

/// The kind of map by the extension and content of a file.
std::optional<MapSpec> kind_of_file(const fs::path& path) {
  const std::string extension = map_extension(path);
  for (MapSpec& spec : every_kind()) {
    const auto format = file_format(spec);
    if (!format || std::ranges::find(format->extensions, extension) == format->extensions.end())
      continue;
    if (std::holds_alternative<RectanglesMap>(spec) && is_matrix_file(path)) return MatrixMap{};
    return std::move(spec);
  }
  return std::nullopt;
}

}  // namespace

std::string map_formats() {
  std::vector<std::string_view> names;
  for (const MapSpec& spec : every_kind())
    if (const auto format = file_format(spec)) names.push_back(format->name);
  const std::string_view last = names.back();
  names.pop_back();
  return fmt::format("{} or {}", fmt::join(names, ", "), last);
}

bool is_of_map(const Setting& setting) { return is_in_key(setting.key, "map"); }

MapSpec choose_map_spec(const fs::path& path, const MapChoice& choice) {
  const std::string file = path.string();
  const auto fail = [&](const std::string& why) { throw InputError(file, why); };
  if (::access(path.c_str(), F_OK) != 0) fail("cannot read: No such file or directory");
  if (choice.um_per_px && !(*choice.um_per_px >= 1e-6 && *choice.um_per_px <= 1e6))
    fail(input_name("um_per_px") + " is " + number_text(*choice.um_per_px) +
         ", must be within 1e-6..1e6");
  if (choice.um_per_unit && !(*choice.um_per_unit >= 1e-9 && *choice.um_per_unit <= 1e9))
    fail(input_name("um_per_unit") + " is " + number_text(*choice.um_per_unit) +
         ", must be within 1e-9..1e9");

  std::optional<MapSpec> kind = kind_of_file(path);
  if (!kind && !chooses_type(choice.settings))
    throw InputError(file, fmt::format("no map that is known, expected: {}{}", map_formats(),
                                       advice_on_no_map(path)));
  for (const Setting& setting : choice.settings.list)
    if (setting.key == "map.file")
      throw InputError(setting_location(choice.settings.option, setting.key),
                       "the file is given already: " + file);
  MapKey chosen{kind.value_or(MapSpec())};
  set_values(chosen, choice.settings);
  std::string* name = file_name(chosen.map);
  if (!name) fail("map.type is one that is read from no file");
  *name = file;
  set_scale(chosen.map, choice, fail);
  return std::move(chosen.map);
}

MapSpec guess_map_spec(const fs::path& path, std::optional<double> um_per_px) {
  return choose_map_spec(path, {.um_per_px = um_per_px});
}

}  // namespace microswarm::formats
