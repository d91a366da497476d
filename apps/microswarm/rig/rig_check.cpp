// SPDX-License-Identifier: Apache-2.0
// `rig check` tests every device and value of a rig file.
#include <ctime>
#include <memory>
#include <nlohmann/json.hpp>

#include "microswarm/rig/commissioning/commissioning.hpp"
#include "microswarm/rig/runtime/devices.hpp"
#include "microswarm/rig/runtime/rig_checks.hpp"
#include "microswarm/rig/session/open_on_rig.hpp"
#include "microswarm/rig/watch/map_check.hpp"
#include "microswarm/vision/camera/newest_frame.hpp"
#include "rig/rig.hpp"
#include "rig/rig_settings.hpp"
#include "support/options.hpp"

namespace microswarm::cli {
namespace {

using Json = nlohmann::ordered_json;

struct CheckOptions {
  std::string rig;
  std::string scenario;
  std::vector<std::string> settings;
  double seconds = 2;
  bool json = false;
};

/// Prints the answers one by one, or all together as JSON.
class Answers {
 public:
  explicit Answers(bool as_json) : as_json_(as_json) {}
  void say(bool good, const std::string& what, const std::string& answer) {
    failed_ += !good;
    if (as_json_) {
      list_.push_back({{"what", what}, {"ok", good}, {"answer", answer}});
      return;
    }
    print("{:<4} {:<9} {}\n", good ? "ok" : "NO", what, answer);
    flush_output();
  }
  bool all_good() const { return failed_ == 0; }
  void finish() const {
    if (as_json_)
      print("{}\n", Json{{"ok", all_good()}, {"answers", list_}}.dump(2));
    else if (all_good())
      print("everything is as it should be\n");
  }

 private:
  bool as_json_;
  int failed_ = 0;
  Json list_ = Json::array();
};

void answer(Answers& answers, const std::vector<rig::RigCheck>& checks) {
  for (const rig::RigCheck& check : checks) answers.say(check.good, check.what, check.answer);
}

void answer(Answers& answers, const rig::MapCheck& map) { answers.say(map.good, "map", map.text); }

/// Compares the scenario's map with the newest picture.
void ask_map(const rig::RigExperiment& on, vision::NewestFrame& camera, Answers& answers) {
  constexpr double longest = 5;  // [s] to the next picture
  vision::LiveFrame frame;
  if (!on.rig.params.scale || !camera.wait(frame, longest)) return;
  formats::Image grey;
  vision::take_channel(frame.frame.picture, vision::VideoChannel::grey, grey);
  const rig::PictureRegistration registration(*on.experiment.world.map,
                                              {*on.rig.params.scale, grey.width, grey.height});
  answer(answers,
         rig::check_map(registration.fit(grey, true), on.rig.params.safety.max_map_shift_px));
}

void ask_camera(const rig::Rig& rig, const std::optional<rig::RigExperiment>& on,
                const CheckOptions& o, const Stop& stop, Answers& answers) {
  if (rig::camera_kind(rig.params) == rig::CameraKind::simulated) {
    answers.say(true, "camera", "simulated");
    if (on) answer(answers, rig::check_simulated_map(*on));
    return;
  }
  try {
    std::unique_ptr<vision::FrameSource> source = rig::open_rig_camera(rig);
    note_each(source->notes());
    const std::optional<double> rate = source->rate();
    vision::NewestFrame camera(std::move(source), "camera", rig::camera_watch(rig.params));
    answer(answers, rig::check_camera(camera, rig, rate, o.seconds, stop));
    if (on) ask_map(*on, camera, answers);
  } catch (const std::runtime_error& e) {
    answers.say(false, "camera", e.what());
  }
  answers.say(rig.params.scale.has_value(), "scale",
              rig.params.scale ? fmt::format("{:.6g} µm a pixel", rig.params.scale->um_per_px)
                               : "missing, see `microswarm rig scale`");
}

void ask_driver(const rig::Rig& rig, const CheckOptions& o, const Stop& stop, Answers& answers) {
  if (!rig::has_coil_device(rig)) return answers.say(true, "driver", "simulated");
  try {
    const std::unique_ptr<actuation::CoilDriver> driver = rig::open_coils(rig);
    answer(answers, rig::check_driver(*driver, rig, o.seconds, stop));
  } catch (const std::runtime_error& e) {
    answers.say(false, "driver", e.what());
  }
}

int rig_check(const CheckOptions& o, const Stop& stop) {
  std::optional<rig::RigExperiment> on;
  if (!o.scenario.empty())
    on = rig::open_rig_experiment(o.scenario, {}, o.rig, {o.settings, "--set"});
  const rig::Rig rig = on ? on->rig : rig::read_rig(o.rig, {o.settings, "--set"});
  Answers answers(o.json);
  answers.say(true, "coils", fmt::format("{}: {} coils", rig.system.name(), rig.system.size()));
  answer(answers, {rig::check_field(rig)});
  if (rig::has_coil_device(rig))
    for (const Issue& issue : rig::missing_limits(rig)) answers.say(false, "limits", issue.text);
  const rig::CommissioningState commissioning = rig::commissioning_state(rig);
  if (const std::string state = to_text(commissioning, std::time(nullptr)); !state.empty())
    answers.say(rig::missing_commissioning(rig, commissioning).empty(), "measured", state);
  if (rig::has_coil_device(rig) || rig.params.realtime_priority > 0)
    answer(answers, {rig::check_computer(rig, o.seconds, stop)});
  ask_camera(rig, on, o, stop, answers);
  ask_driver(rig, o, stop, answers);
  if (stop()) return not_reached;
  answers.finish();
  return answers.all_good() ? ok : hardware;
}

}  // namespace

void add_rig_check(Command rig, Action& action) {
  auto o = std::make_shared<CheckOptions>();
  Command cmd = rig.add_command("check", "Check camera, coil driver, limits and latency of a rig",
                                "rig check scenarios/rigs/vortex.yaml");
  cmd.add_option("rig", o->rig, "Rig file (YAML)").required().type_name("FILE").input("rigs");
  cmd.add_option("--scenario", o->scenario,
                 "Scenario file (YAML): does its map lie over the camera's picture?")
      .type_name("FILE")
      .input("papers");
  add_rig_settings(cmd, "--set", o->settings);
  cmd.add_option("--seconds", o->seconds, "Test duration per device")
      .type_name("SECONDS")
      .check(number(0.1, 600));
  add_json(cmd, o->json);
  cmd.callback([o, &action] {
    action = [o](const Context& context) { return rig_check(*o, context.stop); };
  });
}

}  // namespace microswarm::cli
