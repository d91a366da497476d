// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "microswarm/config/type.hpp"
#include "microswarm/formats/choose_map_spec.hpp"
#include "microswarm/formats/images/image.hpp"
#include "microswarm/formats/map_file.hpp"
#include "microswarm/report/run_report.hpp"
#include "support/cli.hpp"
#include "support/command.hpp"

namespace microswarm::cli {

/// A map of the command line: the file, and how it is read.
struct MapInput {
  std::string file;
  std::optional<double> um_per_px;
  std::optional<double> um_per_unit;
  std::string um_per_px_option = "--um-per-px";  ///< "--map-um-per-px" beside a photograph's
};
/// Adds the map, `--um-per-px` (or what `um_per_px_option` says) and `--um-per-unit`.
void add_map_input(Command command, MapInput& input);
/// The map's spec by its options and those of the settings that are of `map`. Throws InputError.
formats::MapSpec choose_map_spec(const MapInput& input, const std::vector<std::string>& settings);
/// Reads the map and prints its notes. Throws InputError.
formats::LoadedMap load_map(const MapInput& input, const std::vector<std::string>& settings);
/// The settings that are not of `map`.
std::vector<std::string> other_settings(const std::vector<std::string>& settings);

/// Keys of `--set` of a command that reads a map and plans; for completion and the reference.
template <class Planners>
struct MapAndPlanner {
  formats::MapSpec map;
  Planners planner;
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.map, plain("map", "How the map file is read."));
    visit(self.planner, plain("planner", "Planner and its parameters."));
  }
};

/// Options shared by several commands.
void add_map_file(Command command, std::string& file);
void add_um_per_px(Command command, std::optional<double>& value, const char* doc);
/// Adds `--set KEY=VALUE`; `keys()` is called for completion only.
void add_settings(Command command, std::vector<std::string>& values, const char* doc,
                  const Type& (*keys)());
/// Completes keys of `keys()` and, after `=`, their values.
Suggest suggest_settings(const Type& (*keys)());
void add_json(Command command, bool& value);

/// Reads a photograph; what was assumed in it is a note. Throws InputError.
formats::Image read_photo(const std::string& file);
/// The same; a scale that is not given is what ImageJ or OME wrote into the file, and a note.
formats::Image read_photo(const std::string& file, std::optional<double>& um_per_px);

/// Option `--photo` with its `--um-per-px`, for commands that draw reports.
struct PhotoOptions {
  std::string file;
  std::optional<double> um_per_px;
};
void add_photo(Command command, PhotoOptions& options);
/// Reads the photograph if one is given. Throws InputError.
report::ReportOptions report_options(const PhotoOptions& options);

/// Summary of reproduction or benchmark rows: "11 of 14 aims are met, 3 have no verdict".
template <class Row>
std::string aims_met(const std::vector<Row>& rows) {
  const auto count = [&](auto&& is) { return std::count_if(rows.begin(), rows.end(), is); };
  const auto judged = count([](const Row& r) { return r.has_verdict(); });
  const auto met = count([](const Row& r) { return r.has_verdict() && r.ok(); });
  const auto open = count([](const Row& r) { return r.aim && !r.has_verdict(); });
  return fmt::format("{} of {} aims are met{}\n", met, judged,
                     open == 0 ? "" : fmt::format(", {} have no verdict", open));
}

/// Numbers of a list "200,500,-90" or "200, 500, -90"; empty for another text.
std::vector<double> numbers(std::string_view text);

}  // namespace microswarm::cli
