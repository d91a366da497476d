// SPDX-License-Identifier: Apache-2.0
#include "lab/files/photograph.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

#include "microswarm/config/schema.hpp"
#include "microswarm/config/yaml.hpp"
#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/text/file.hpp"
#include "microswarm/experiment/scenario/map_scale.hpp"
#include "microswarm/experiment/scenario/validate.hpp"
#include "microswarm/formats/images/jpeg.hpp"
#include "microswarm/formats/write_map.hpp"
#include "microswarm/planning/common/free_goal.hpp"
#include "microswarm/vision/image/overlay.hpp"
#include "microswarm/vision/vessels/vessel_map.hpp"
#include "microswarm/world/connectivity/channel_width.hpp"

namespace microswarm::lab {
namespace {

constexpr double smoothing = 1;  // [px], of the outlines
constexpr int jpeg_quality = 90;
constexpr int max_steps = 100'000;

/// Clearance that a swarm needs at its start and goal, in channels of this width.
double swarm_clearance(double width) {
  experiment::Scenario scenario;
  experiment::fit_swarm(scenario, width);
  return 1.4 * swarm_limits(scenario.swarm).radius;
}

/// The vessels in which a swarm can be that suits their width; empty if there are none.
formats::Mask roomy(const vision::VesselSegmentation& found) {
  try {
    const Map map = vision::vessel_map(found, 1, smoothing, "photograph");
    Rng rng(1, Purpose::planner);
    const double clearance = swarm_clearance(channel_width(map, rng));
    return vision::wide_vessels(found, 2 * clearance);
  } catch (const InputError&) {
    return {found.vessels.width, found.vessels.height};
  }
}

void tint(formats::Image& picture, const formats::Mask& mask) {
  constexpr std::array<int, 3> colour{0, 230, 200};
  for (std::size_t i = 0; i < mask.cells.size(); ++i)
    for (std::size_t k = 0; mask.cells[i] && k < 3; ++k) {
      std::uint8_t& value = picture.pixels[3 * i + k];
      value = static_cast<std::uint8_t>((value + colour[k] * 2) / 3);
    }
}

double share_of(const formats::Mask& part, const formats::Mask& whole) {
  const auto all = std::ranges::count(whole.cells, 1);
  return all > 0 ? static_cast<double>(std::ranges::count(part.cells, 1)) / static_cast<double>(all)
                 : 0;
}

/// Nearest position with this clearance. Throws InputError if there is none nearby.
Vec2 free_place(const Map& map, Vec2 at, double clearance, double width, const char* what) {
  const auto found = planning::free_goal(Snapshot::of(map), at, 3 * width, clearance);
  if (!found)
    throw InputError(fmt::format(
        "the {} ({:.0f}, {:.0f}) µm is not in a vessel that is wide enough", what, at.x, at.y));
  return *found;
}

}  // namespace

std::string vessel_schema() { return json_schema<vision::VesselParams>("vessels of a photograph"); }

std::string to_jpeg(const std::filesystem::path& photograph) {
  return formats::encode_jpeg(formats::read_photograph(photograph), jpeg_quality);
}

const vision::VesselSegmentation& VesselSearch::search(const std::filesystem::path& photograph,
                                                       const PhotoRequest& request) {
  const auto written = std::filesystem::last_write_time(photograph);
  if (last_ && last_->photograph == photograph && last_->written == written &&
      last_->settings == request.settings)
    return last_->found;
  vision::VesselParams params;
  set_values(params, {request.settings, ""});
  last_ = Result{photograph, written, request.settings,
                 vision::segment_vessels(formats::read_photograph(photograph), params)};
  return last_->found;
}

FoundVessels VesselSearch::find(const std::filesystem::path& photograph,
                                const PhotoRequest& request) {
  const vision::VesselSegmentation& found = search(photograph, request);
  const formats::Mask wide = roomy(found);
  formats::Image shown = vision::overlay(formats::read_photograph(photograph), found.vessels);
  tint(shown, wide);
  const TemporaryFile picture("overlay.png");
  formats::write_png(picture.path(), shown);
  const nlohmann::json json{{"choice", vision::describe_choice(found)},
                            {"view_share", found.view_share},
                            {"pieces", found.pieces},
                            {"kept_share", found.kept_share},
                            {"swarm_share", share_of(wide, found.vessels)},
                            {"bridges", found.bridges},
                            {"wide_width_px", found.wide_width_px}};
  return {.png = read_file(picture.path()), .json = json.dump()};
}

std::filesystem::path VesselSearch::make_scenario(const std::filesystem::path& photograph,
                                                  const PhotoRequest& request, Uploads& uploads) {
  const double cell = request.um_per_px;
  if (!(cell > 0)) throw InputError("the scale is missing: um_per_px");
  if (!request.goal) throw InputError("the goal is missing");
  if (!request.start && request.robots < 1) throw InputError("start or robots are missing");
  const vision::VesselSegmentation& found = search(photograph, request);
  const Map map = vision::vessel_map(found, cell, smoothing, "photograph");
  Rng rng(1, Purpose::planner);
  const double width = channel_width(map, rng);
  const std::filesystem::path file = uploads.new_file(".geojson");
  formats::write_map(file, map, cell);

  experiment::Scenario scenario;
  scenario.name = "photograph";
  scenario.map = formats::GeoJsonMap{.file = file.filename().string()};
  if (request.start) {
    experiment::fit_swarm(scenario, width);
    const double clearance = swarm_clearance(width);
    scenario.start = Pose2{free_place(map, *request.start, clearance, width, "start"), 0};
    scenario.goal = free_place(map, *request.goal, clearance, width, "goal");
    scenario.time_limit = 3600;
  } else {
    scenario.robots.emplace().count = request.robots;
    scenario.goal = free_place(map, *request.goal, 0.05 * width, width, "place to gather");
    scenario.navigator = navigation::AggregationParams{};
    experiment::fit_gathering(scenario, width, width_around(map, *scenario.goal), max_steps);
  }
  const std::filesystem::path made = uploads.new_file(".yaml");
  write_file_atomically(made, experiment::scenario_text(scenario));
  experiment::open_experiment(made);  // reports inconsistent values
  return made;
}

}  // namespace microswarm::lab
