// SPDX-License-Identifier: Apache-2.0
#include "support/options.hpp"

#include <fmt/format.h>

#include "microswarm/config/setting_keys.hpp"
#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/text/lines.hpp"
#include "microswarm/core/text/text.hpp"
#include "microswarm/formats/choose_map_spec.hpp"
#include "microswarm/formats/map_file.hpp"

namespace microswarm::cli {

namespace {

/// The settings that are of `map`, or the others.
Settings split_settings(const std::vector<std::string>& texts, bool of_map) {
  Settings settings(texts, "--set");
  std::erase_if(settings.list,
                [&](const Setting& setting) { return formats::is_of_map(setting) != of_map; });
  return settings;
}

}  // namespace

void add_map_file(Command command, std::string& file) {
  command.add_option("map", file, fmt::format("Map: {}", formats::map_formats()).c_str())
      .required()
      .type_name("FILE")
      .input("maps");
}

void add_map_input(Command command, MapInput& input) {
  add_map_file(command, input.file);
  command
      .add_option(input.um_per_px_option.c_str(), input.um_per_px,
                  "µm per pixel or cell of the map, 1e-6..1e6")
      .type_name("NUMBER")
      .check(number(1e-6, 1e6));
  command
      .add_option("--um-per-unit", input.um_per_unit,
                  "µm for a unit of GeoJSON, SVG, CSV or ROS (m)")
      .type_name("NUMBER")
      .check(number(1e-9, 1e9));
}

formats::MapSpec choose_map_spec(const MapInput& input, const std::vector<std::string>& settings) {
  return formats::choose_map_spec(input.file, {.um_per_px = input.um_per_px,
                                               .um_per_unit = input.um_per_unit,
                                               .settings = split_settings(settings, true)});
}

formats::LoadedMap load_map(const MapInput& input, const std::vector<std::string>& settings) {
  formats::LoadedMap loaded =
      reading([&] { return formats::load_map(choose_map_spec(input, settings)); });
  note_each(loaded.notes);
  return loaded;
}

std::vector<std::string> other_settings(const std::vector<std::string>& settings) {
  return split_settings(settings, false).texts();
}

void add_um_per_px(Command command, std::optional<double>& value, const char* doc) {
  command.add_option("--um-per-px", value, doc).type_name("NUMBER").check(number(1e-6, 1e6));
}

void add_settings(Command command, std::vector<std::string>& values, const char* doc,
                  const Type& (*keys)()) {
  command.add_option("--set", values, doc)
      .type_name("KEY=VALUE")
      .repeatable()
      .suggest(suggest_settings(keys));
}

Suggest suggest_settings(const Type& (*keys)()) {
  return [keys](const std::string& typed) {
    std::vector<Suggestion> offered;
    for (const SettingKey& key : setting_keys(keys())) {
      const std::string assigned = key.key + "=";
      if (!typed.starts_with(assigned)) {
        offered.push_back({assigned, std::string(key.doc)});
        continue;
      }
      for (const std::string_view word : key.words)
        offered.push_back({assigned + std::string(word), {}});
    }
    return offered;
  };
}

void add_json(Command command, bool& value) {
  command.add_flag("--json", value, "Print the result as JSON");
}

formats::Image read_photo(const std::string& file) {
  std::optional<double> given = 1;
  return read_photo(file, given);
}

formats::Image read_photo(const std::string& file, std::optional<double>& um_per_px) {
  formats::ReadPicture picture = formats::read_picture(file);
  note_each(picture.notes);
  if (!um_per_px && picture.um_per_px) {
    um_per_px = picture.um_per_px;
    note("note: {}: a pixel is {:.6g} µm, as the file says\n", file, *um_per_px);
  }
  return std::move(picture.image);
}

void add_photo(Command command, PhotoOptions& options) {
  command.add_option("--photo", options.file, "Photograph as background of the pictures")
      .type_name("FILE")
      .input();
  add_um_per_px(command, options.um_per_px, "µm per pixel of the photograph, 1e-6..1e6");
  command.option("--um-per-px").needs("--photo");
}

report::ReportOptions report_options(const PhotoOptions& options) {
  if (options.file.empty()) return {};
  if (!options.um_per_px) throw InputError(options.file, "µm per px is missing: give --um-per-px");
  return {read_photo(options.file), *options.um_per_px};
}

std::vector<double> numbers(std::string_view text) {
  std::vector<double> values;
  for (const std::string_view piece : split(text, ',')) {
    const std::optional<double> value = parse_number(piece);
    if (!value) return {};
    values.push_back(*value);
  }
  return values;
}

}  // namespace microswarm::cli
