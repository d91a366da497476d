// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>
#include <variant>

#include "microswarm/config/key_locations.hpp"
#include "microswarm/config/yaml.hpp"
#include "microswarm/core/errors/error.hpp"
#include "microswarm/experiment/scenario/experiment.hpp"
#include "microswarm/rig/params/rig_params.hpp"
#include "microswarm/rig/perception/scenario_overlay.hpp"
#include "microswarm/rig/perception/swarm_perception.hpp"
#include "microswarm/rig/simulation/rig_simulator.hpp"
#include "microswarm/vision/scene/scene_overlay.hpp"
#include "microswarm/vision/scene/wall_finder.hpp"
#include "rig/camera/still.hpp"
#include "rig/rig.hpp"
#include "support/options.hpp"

namespace microswarm::cli {
namespace {

using Json = nlohmann::ordered_json;

/// Keys of `--config` and `--set`.
struct SeeSettings {
  vision::AnyCameraParams camera;
  vision::SceneParams scene;
  vision::WallParams walls;
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.camera, plain("camera", "Camera from which a picture is taken."));
    visit(self.scene, plain("scene", "Detection of the swarm and the obstacles."));
    visit(self.walls, plain("walls", "Detection of walls in the still picture."));
  }
};

struct SeeOptions {
  std::string picture;
  std::string rig;
  std::string still;
  std::string config;
  std::vector<std::string> settings;
  std::string scenario;
  std::string out;
  bool json = false;
};

/// Reads a picture of the same scene. Throws InputError if its size differs.
formats::Image read_still(const std::string& file, const formats::Image& picture) {
  formats::Image still = read_photo(file);
  if (still.width != picture.width || still.height != picture.height)
    throw InputError(file, fmt::format("is {} × {} px, the picture is {} × {} px", still.width,
                                       still.height, picture.width, picture.height));
  return still;
}

Json to_json(const vision::Blob& b) {
  return {{"centre_px", {b.centre_px.x, b.centre_px.y}},
          {"radius_px", b.radius_px},
          {"semi_axes_px", {b.semi_major_px, b.semi_minor_px}},
          {"angle_rad", b.angle},
          {"contrast", b.contrast},
          {"texture", b.texture},
          {"is_cut", b.is_cut}};
}

std::string to_text(const vision::Blob& b) {
  return fmt::format(
      "({:.2f}, {:.2f}) px, radius {:.2f} px, axes {:.1f} and {:.1f} px, contrast "
      "{:.0f}, texture {:.1f}{}",
      b.centre_px.x, b.centre_px.y, b.radius_px, b.semi_major_px, b.semi_minor_px, b.contrast,
      b.texture, b.is_cut ? ", cut" : "");
}

Json to_json(const vision::NotSwarm& no) {
  Json json = to_json(no.blob);
  json["criterion"] = enum_name(no.criterion);
  if (no.criterion != vision::SwarmCriterion::tone) {
    json["value"] = no.value;
    json["limit"] = no.limit;
  }
  json["key"] = no.key;
  json["reason"] = vision::reason(no);
  return json;
}

/// Settings of the rig or the settings file, then of `--set`.
SeeSettings to_settings(const SeeOptions& o) {
  SeeSettings settings;
  if (!o.rig.empty()) {
    const rig::Rig rig = rig::read_rig(o.rig);
    settings.scene = rig.params.perception.scene;
    settings.camera = rig::device_camera(rig.params).value_or(settings.camera);
  }
  settings.camera = camera_for(o.picture, settings.camera);
  if (o.config.empty()) {
    note_each(set_values(settings, {o.settings, "--set"}));
    return settings;
  }
  KeyLocations keys;
  settings = read_yaml_file<SeeSettings>(o.config, {o.settings, "--set"}, keys);
  note_each(keys.notes());
  return settings;
}

/// A scenario and its position in the camera's picture.
struct Overlay {
  experiment::Experiment experiment;
  vision::CameraScale scale;
  rig::PerceptionParams perception;
};

std::optional<Overlay> read_overlay(const SeeOptions& o) {
  if (o.scenario.empty()) return std::nullopt;
  if (o.out.empty() || o.rig.empty())
    throw InputError("rig see: --scenario needs --rig, whose scale it takes, and --out");
  const rig::Rig rig = rig::read_rig(o.rig);
  if (!rig.params.scale)
    throw rig.keys.error("scale", "`scale` is missing, see `microswarm rig scale`");
  return Overlay{reading([&] { return experiment::open_experiment(o.scenario); }),
                 *rig.params.scale, rig.params.perception};
}

void draw_overlay(formats::Image& shown, const Overlay& over) {
  const experiment::Scenario& scenario = over.experiment.scenario();
  rig::draw_scenario(shown, scenario, *over.experiment.world.map, over.scale);
  const std::vector<Vec2> positions = rig::robot_positions(scenario);
  const auto outside = std::ranges::count_if(positions, [&](Vec2 position) {
    const Vec2 at = over.scale.to_picture(position);
    return at.x < -0.5 || at.y < -0.5 || at.x > shown.width - 0.5 || at.y > shown.height - 0.5;
  });
  if (outside > 0)
    note("note: {} of {} starts and goals are outside the picture\n", outside, positions.size());
}

/// Start of the scenario's swarm in the picture, if it is one body.
std::optional<Vec2> start_position(const std::optional<Overlay>& over) {
  if (!over || !over->experiment.scenario().start) return std::nullopt;
  return over->scale.to_picture(over->experiment.scenario().start->position);
}

/// Size that a smooth swarm must have.
vision::SwarmPrior swarm_prior(const std::optional<Overlay>& over) {
  if (!start_position(over)) return {};
  return rig::expected_swarm(swarm_limits(over->experiment.scenario().swarm), over->perception,
                             over->scale);
}

/// Description of a picture's detections.
struct Told {
  vision::SeenScene scene;
  std::vector<vision::NotSwarm> not_swarm;
  std::optional<Vec2> start_px;
  double um_per_px = 1;
  double contrast_limit = 0;

  /// Distance from the start, as text.
  std::string off(const vision::Blob& b) const {
    if (!start_px) return {};
    const double off = distance(b.centre_px, *start_px);
    return fmt::format(", {:.0f} px ({:.4g} µm) from the start", off, off * um_per_px);
  }
  Json with_distance(Json json, const vision::Blob& b) const {
    if (start_px) json["distance_from_start_um"] = distance(b.centre_px, *start_px) * um_per_px;
    return json;
  }
};

std::string json_text(const Told& told) {
  Json json{{"swarm", enum_name(told.scene.swarm.sight)},
            {"contrast_limit", told.contrast_limit},
            {"candidates", Json::array()},
            {"not_swarm", Json::array()},
            {"obstacles", Json::array()}};
  for (const vision::Blob& b : told.scene.swarm.candidates)
    json["candidates"].push_back(told.with_distance(to_json(b), b));
  for (const vision::NotSwarm& no : told.not_swarm)
    json["not_swarm"].push_back(told.with_distance(to_json(no), no.blob));
  for (const vision::SeenObstacle& b : told.scene.obstacles) {
    json["obstacles"].push_back(to_json(b.blob));
    json["obstacles"].back()["shape"] = b.disc ? "disc" : "polygon";
  }
  return json.dump(2);
}

void tell(const Told& told) {
  print("swarm: {}\n", enum_name(told.scene.swarm.sight));
  for (const vision::Blob& b : told.scene.swarm.candidates)
    print("  {}{}\n", to_text(b), told.off(b));
  print("not the swarm: {}\n", told.not_swarm.size());
  for (const vision::NotSwarm& no : told.not_swarm)
    print("  {}: {}{}\n", vision::reason(no), to_text(no.blob), told.off(no.blob));
  if (told.not_swarm.empty() && told.scene.swarm.candidates.empty())
    print(
        "  nothing has a contrast above {:.1f}: `min_contrast` or five times the background's "
        "spread "
        "(stripes, or a swarm on half of the view or more, widen it)\n",
        told.contrast_limit);
  print("obstacles: {}\n", told.scene.obstacles.size());
  for (const vision::SeenObstacle& b : told.scene.obstacles)
    print("  {} {}\n", b.disc ? "disc" : "polygon", to_text(b.blob));
}

/// Warns on stderr if a run would not accept the swarm at this position.
void note_far(const Told& told, double jump) {
  if (!told.start_px || !told.scene.swarm.swarm) return;
  const double off = distance(told.scene.swarm.swarm->centre_px, *told.start_px);
  if (off > jump)
    note(
        "note: the swarm is {:.0f} px from the start; `rig run` searches it within {:.4g} px "
        "(scene.swarm.jump_px)\n",
        off, jump);
}

int see(const SeeOptions& o) {
  for (const std::string& input : {o.picture, o.still, o.config, o.rig, o.scenario})
    keep_input(o.out, input);
  const SeeSettings settings = to_settings(o);
  Issues issues = validate(settings.scene.swarm.look);
  issues.add(validate(settings.scene.obstacles));
  KeyLocations().require_none(issues);
  const std::optional<Overlay> over = read_overlay(o);
  const formats::Image picture = take_picture(o.picture, settings.camera);
  std::optional<formats::Mask> walls;
  if (!o.still.empty()) walls = vision::find_walls(read_still(o.still, picture), settings.walls);
  const formats::Mask* hidden = walls ? &*walls : nullptr;
  const vision::SceneParams& params = settings.scene;
  const vision::SwarmPrior prior = swarm_prior(over);
  Told told{.scene = vision::find_scene(picture, params, prior, hidden),
            .not_swarm = {},
            .start_px = start_position(over),
            .um_per_px = over ? over->scale.um_per_px : 1,
            .contrast_limit = contrast_limit(picture, params.swarm.look, hidden)};
  told.not_swarm = vision::why_not_swarm(told.scene, picture, params, prior, hidden);
  if (!o.out.empty()) {
    formats::Image shown = vision::draw_scene(picture, told.scene, hidden);
    vision::draw_reasons(shown, told.not_swarm);
    if (over) draw_overlay(shown, *over);
    formats::write_png(o.out, shown);
  }
  note_far(told, params.swarm.jump);
  if (o.json) {
    print("{}\n", json_text(told));
  } else {
    tell(told);
    if (!o.out.empty()) print("wrote {}\n", o.out);
  }
  return told.scene.swarm.sight == vision::SwarmSight::found ? ok : not_reached;
}

}  // namespace

void add_rig_see(Command rig, Action& action) {
  auto o = std::make_shared<SeeOptions>();
  Command cmd = rig.add_command(
      "see", "Detect the swarm and obstacles in a picture",
      "rig see samples/rig/frame.png --set scene.swarm.look.min_radius_px=10 --out seen.png");
  cmd.add_option("picture", o->picture, "Picture, or camera such as /dev/video0 or genicam:ID")
      .required()
      .type_name("FILE")
      .input();
  cmd.add_option("--still", o->still, "Picture without swarm and obstacles, for detecting walls")
      .type_name("FILE");
  const Option rig_file =
      cmd.add_option("--rig", o->rig, "Use the settings of this rig (YAML); --set overrides them")
          .type_name("FILE")
          .input("rigs");
  cmd.add_option("--config", o->config, "Settings file (YAML); --set overrides it")
      .type_name("FILE")
      .input()
      .excludes(rig_file);
  cmd.add_option("--scenario", o->scenario,
                 "Draw map, start and goal of this scenario over the picture, by the rig's scale")
      .type_name("FILE")
      .input("papers");
  add_settings(cmd, o->settings, "Override a value, e.g. scene.swarm.look.min_radius_px=12",
               type_of<SeeSettings>);
  cmd.add_option("--out", o->out, "Draw the detections to this file (PNG)")
      .type_name("FILE")
      .check(file_kind({".png"}));
  add_json(cmd, o->json);
  cmd.callback([o, &action] { action = [o](const Context&) { return see(*o); }; });
}

}  // namespace microswarm::cli
