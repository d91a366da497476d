// SPDX-License-Identifier: Apache-2.0
// `rig check` tests every device and value of a rig file.
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>

#include "microswarm/actuation/coils/coil_controller.hpp"
#include "microswarm/core/execution/clock.hpp"
#include "microswarm/core/execution/durations.hpp"
#include "microswarm/core/maths/angles.hpp"
#include "microswarm/rig/runtime/devices.hpp"
#include "microswarm/vision/camera/newest_frame.hpp"
#include "rig/rig.hpp"
#include "rig/rig_notes.hpp"
#include "support/options.hpp"

namespace microswarm::cli {
namespace {

using Json = nlohmann::ordered_json;

struct CheckOptions {
  std::string rig;
  std::vector<std::string> settings;
  double seconds = 2;
  bool json = false;
};

/// Collects the answers: printed at once, or all together as JSON.
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

void check_camera(const Rig& rig, const CheckOptions& o, const Stop& stop, Answers& answers) {
  if (std::holds_alternative<SimulatedCamera>(rig.params.camera))
    return answers.say(true, "camera", "simulated");
  try {
    std::unique_ptr<FrameSource> source = open_camera_of(rig);
    const std::optional<double> rate = source->rate();
    NewestFrame camera(std::move(source), "camera");
    LiveFrame frame;
    Durations gaps;
    double before = 0;
    const double began = steady_seconds();
    while (steady_seconds() < began + o.seconds && !stop()) {
      if (!camera.wait(frame, 0.1)) continue;
      if (before > 0) gaps.add(frame.taken - before);
      before = frame.taken;
    }
    const CameraStatus status = camera.status();
    const bool is_video = std::holds_alternative<VideoCamera>(rig.params.camera);
    const bool good = gaps.count() > 0 && (status.state == CameraState::live ||
                                           (is_video && status.state == CameraState::ended));
    answers.say(
        good, "camera",
        fmt::format(
            "{}, {} frames of {} × {} in {:.3g} s; {}", enum_name(status.state), status.frames,
            frame.frame.picture.width, frame.frame.picture.height, steady_seconds() - began,
            gaps.count() > 0 ? fmt::format("between frames {} (p50 / p95 / p99)", quantiles(gaps))
                             : "too few to tell the time between them"));
    if (const double usual = gaps.quantile(0.5); rate && gaps.count() > 0)
      answers.say(usual <= 1.1 / *rate, "frames",
                  fmt::format("{:.4g} ms apart as a rule, {:.6g} Hz means {:.4g}", 1e3 * usual,
                              *rate, 1e3 / *rate));
    if (const double longest = gaps.quantile(1); longest > rig.params.safety.max_frame_age)
      answers.say(false, "frames",
                  fmt::format("{:.3g} s apart, safety.max_frame_age_s is {:.6g}", longest,
                              rig.params.safety.max_frame_age));
  } catch (const std::runtime_error& e) {
    answers.say(false, "camera", e.what());
  }
  answers.say(rig.params.scale.has_value(), "scale",
              rig.params.scale ? fmt::format("{:.6g} µm a pixel", rig.params.scale->um_per_px)
                               : "missing, see `microswarm rig scale`");
}

void check_driver(const Rig& rig, const CheckOptions& o, const Stop& stop, Answers& answers) {
  const auto* serial = std::get_if<SerialCoilParams>(&rig.params.driver);
  if (!serial) return answers.say(true, "driver", "simulated");
  try {
    SerialCoilDriver driver(*serial);
    Durations times;
    int failures = 0;
    bool unarmed = false;
    const std::vector<double> nothing(static_cast<std::size_t>(driver.channels()));
    for (const double end = steady_seconds() + o.seconds; steady_seconds() < end && !stop();) {
      const double began = steady_seconds();
      const DriveStatus status = driver.drive(nothing);
      failures += status == DriveStatus::no_answer;
      unarmed = unarmed || status == DriveStatus::not_armed;
      times.add(steady_seconds() - began);
    }
    const bool zero = driver.stop();
    const double slow = times.quantile(0.99);
    answers.say(
        failures == 0, "driver",
        fmt::format(
            "{} exchanges with all currents at zero, {} without an answer; {} (p50 / p95 / p99)",
            times.count(), failures, quantiles(times)));
    if (unarmed) answers.say(false, "driver", "the device does not let itself be armed");
    answers.say(zero, "stop", zero ? "confirmed" : "not confirmed");
    answers.say(
        slow < 1 / rig.params.drive_rate, "pace",
        fmt::format("an exchange takes {:.2f} ms at p99, drive_rate_hz {:.6g} allows {:.2f}",
                    1e3 * slow, rig.params.drive_rate, 1e3 / rig.params.drive_rate));
  } catch (const std::runtime_error& e) {
    answers.say(false, "driver", e.what());
  }
}

/// Lists the limits that the coil system file does not set.
std::string missing_limits(const Rig& rig) {
  bool voltage = true, temperature = true;
  for (const DriveParams& drive : rig.system.drives()) {
    voltage = voltage && drive.max_voltage;
    temperature = temperature && drive.max_temperature;
  }
  if (voltage && temperature) return {};
  return fmt::format("; {} does not limit the {}", rig.params.coils,
                     voltage       ? "temperature"
                     : temperature ? "voltage"
                                   : "voltage and the temperature");
}

/// Checks whether the coils can hold the rig's field in every direction.
void check_limits(const Rig& rig, Answers& answers) {
  const auto* serial = std::get_if<SerialCoilParams>(&rig.params.driver);
  const double full_scale =
      serial ? serial->full_scale : std::get<SimulatedCoils>(rig.params.driver).full_scale;
  SimulatedCoilDriver driver(static_cast<int>(rig.system.size()), full_scale);
  CoilController controller(rig.system, rig.params.field, driver, 0);
  double least = 1;
  bool reached = true;
  const double dt = 1 / rig.params.drive_rate;
  for (const double heading : {0.0, 0.5 * pi, 1.0, -2.0}) {
    controller.command({heading, 1e9});
    for (int i = 0; i < static_cast<int>(2 / dt); ++i) {
      const CoilOutput& output = controller.advance(dt);
      if (i * dt > 0.5) least = std::min(least, output.scale);
      reached = reached && output.reached;
    }
  }
  const double amplitude = rig.params.field.amplitude;
  answers.say(
      least >= 1 && reached, "limits",
      !reached ? "these coils cannot make every field that is needed"
      : least < 1
          ? fmt::format("the coils' limits weaken the field to {:.3g} mT, {:.6g} mT is meant",
                        least * amplitude, amplitude)
          : fmt::format("the coils hold {:.6g} mT in every direction{}", amplitude,
                        missing_limits(rig)));
}

int rig_check(const CheckOptions& o, const Stop& stop) {
  const Rig rig = read_rig(o.rig, o.settings);
  Answers answers(o.json);
  answers.say(true, "coils", fmt::format("{}: {} coils", rig.system.name(), rig.system.size()));
  check_limits(rig, answers);
  check_camera(rig, o, stop, answers);
  check_driver(rig, o, stop, answers);
  if (stop()) return not_reached;
  answers.finish();
  return answers.all_good() ? ok : hardware;
}

}  // namespace

void add_rig_check(Command rig, Action& action) {
  auto o = std::make_shared<CheckOptions>();
  Command cmd = rig.add_command("check", "Check camera, coil driver, limits and latency of a rig",
                                "rig check rig.yaml");
  cmd.add_option("rig", o->rig, "Rig file (YAML)").required().type_name("FILE");
  cmd.add_option("--set", o->settings, "Override a rig value (repeatable)").type_name("KEY=VALUE");
  cmd.add_option("--seconds", o->seconds, "Test duration per device")
      .type_name("S")
      .check(number(0.1, 600));
  add_json(cmd, o->json);
  cmd.callback([o, &action] {
    action = [o](const Context& context) { return rig_check(*o, context.stop); };
  });
}

}  // namespace microswarm::cli
