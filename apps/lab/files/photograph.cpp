// SPDX-License-Identifier: Apache-2.0
#include "lab/files/photograph.hpp"

#include <fmt/format.h>

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
#include "microswarm/vision/vessels/vessels.hpp"
#include "microswarm/world/connectivity/channel_width.hpp"

namespace microswarm::lab {
namespace {

constexpr double smoothing = 1;  // [px], of the outlines
constexpr int jpeg_quality = 90;
constexpr int max_steps = 100'000;

vision::VesselSegmentation searched(const formats::Image& photo, const PhotoRequest& request) {
  vision::VesselParams params;
  set_values(params, {request.settings, ""});
  return vision::segment_vessels(photo, params);
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

FoundVessels find_vessels(const std::filesystem::path& photograph, const PhotoRequest& request) {
  const formats::Image photo = formats::read_photograph(photograph);
  const vision::VesselSegmentation found = searched(photo, request);
  const TemporaryFile picture("overlay.png");
  formats::write_png(picture.path(), vision::overlay(photo, found.vessels));
  const nlohmann::json json{{"choice", vision::describe_choice(found)},
                            {"view_share", found.view_share},
                            {"pieces", found.pieces},
                            {"kept_share", found.kept_share},
                            {"bridges", found.bridges},
                            {"wide_width_px", found.wide_width_px}};
  return {.png = read_file(picture.path()), .json = json.dump()};
}

std::filesystem::path make_photo_scenario(const std::filesystem::path& photograph,
                                          const PhotoRequest& request, Uploads& uploads) {
  const double cell = request.um_per_px;
  if (!(cell > 0)) throw InputError("the scale is missing: um_per_px");
  if (!request.goal) throw InputError("the goal is missing");
  if (!request.start && request.robots < 1) throw InputError("start or robots are missing");
  const formats::Image photo = formats::read_photograph(photograph);
  const vision::VesselSegmentation found = searched(photo, request);
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
    const double clearance = 1.4 * swarm_limits(scenario.swarm).radius;
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
