// SPDX-License-Identifier: Apache-2.0
#include "microswarm/rig/runtime/rig_checks.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <thread>

#include "microswarm/actuation/amplifiers/coil_heat.hpp"
#include "microswarm/actuation/coils/coil_controller.hpp"
#include "microswarm/core/errors/input_names.hpp"
#include "microswarm/core/execution/clock.hpp"
#include "microswarm/core/execution/priority.hpp"
#include "microswarm/core/maths/angles.hpp"
#include "microswarm/core/maths/infinity.hpp"

namespace microswarm::rig {
namespace {

std::string unlimited(const Rig& rig) {
  const auto& amplifiers = rig.system.amplifiers();
  const bool voltage =
      std::ranges::all_of(amplifiers, [](const actuation::AmplifierParams& amplifier) {
        return amplifier.max_voltage.has_value();
      });
  const bool temperature =
      std::ranges::all_of(amplifiers, [](const actuation::AmplifierParams& amplifier) {
        return amplifier.max_temperature.has_value();
      });
  if (voltage && temperature) return {};
  return fmt::format("; {} does not limit the {}", rig.params.coils,
                     voltage       ? "temperature"
                     : temperature ? "voltage"
                                   : "voltage and the temperature");
}

/// Worst weakening of the field by the limits of the coils, and the time until one is too hot.
struct FieldLoad {
  double scale = 1;
  bool reached = true;
  double lasts = infinity;  ///< time to a coil's maximum temperature, from ambient [s]
  std::size_t hottest = 0;  ///< that coil
};

FieldLoad field_load(const Rig& rig) {
  constexpr double settled = 0.5;  // [s]
  constexpr double lasts = 2;      // [s]
  actuation::SimulatedCoilDriver driver(static_cast<int>(rig.system.size()),
                                        driver_full_scale(rig.params), coil_input(rig.params));
  actuation::CoilController controller(rig.system, rig.params.field, driver, 0);
  FieldLoad load;
  const double dt = 1 / rig.params.drive_rate;
  for (const Command command : {Command{0, 1e9}, Command{0.5 * pi, 1e9}, Command{1, 1e9},
                                Command{-2, 1e9}, Command{0, 0}}) {
    controller.command(command);
    Eigen::ArrayXd squares = Eigen::ArrayXd::Zero(static_cast<Eigen::Index>(rig.system.size()));
    int count = 0;
    for (int i = 0; i < static_cast<int>(lasts / dt); ++i) {
      const actuation::CoilOutput& output = controller.advance(dt);
      load.reached = load.reached && output.reached;
      if (i * dt <= settled) continue;
      load.scale = std::min(load.scale, output.scale);
      squares += output.currents.array().square();
      ++count;
    }
    for (std::size_t k = 0; k < rig.system.size(); ++k) {
      const actuation::AmplifierParams& d = rig.system.amplifiers()[k];
      const double mean_square = squares[static_cast<Eigen::Index>(k)] / std::max(1, count);
      const double time = actuation::time_to_limit(d, d.ambient, mean_square);
      if (time < load.lasts) load.lasts = time, load.hottest = k;
    }
  }
  return load;
}

std::string how_long(const Rig& rig, const FieldLoad& load) {
  const auto& amplifiers = rig.system.amplifiers();
  if (std::isfinite(load.lasts))
    return fmt::format(" for {} from ambient temperature, then coil {} is at its {:.4g} °C",
                       load.lasts < 60 ? fmt::format("{:.2g} s", load.lasts)
                                       : fmt::format("{:.3g} min", std::floor(load.lasts / 6) / 10),
                       rig.system.coil_names()[load.hottest],
                       *amplifiers[load.hottest].max_temperature);
  const bool is_limited = std::ranges::all_of(amplifiers, [](const actuation::AmplifierParams& a) {
    return a.max_temperature.has_value();
  });
  return is_limited ? " indefinitely" : "";
}

/// Durations between frames, and the last frame.
struct Watched {
  Durations gaps;
  vision::LiveFrame frame;
  double seconds = 0;
};

Watched watch(vision::NewestFrame& camera, double seconds, const Stop& stop) {
  Watched watched;
  double before = 0;
  const double began = steady_seconds();
  while (steady_seconds() < began + seconds && !stop()) {
    if (!camera.wait(watched.frame, 0.1)) continue;
    if (before > 0) watched.gaps.add(watched.frame.taken - before);
    before = watched.frame.taken;
  }
  watched.seconds = steady_seconds() - began;
  return watched;
}

/// Whether the coils' probes show temperatures; nothing for a device without probes.
std::optional<RigCheck> check_probes(const actuation::DeviceReport& report, const Rig& rig) {
  const std::vector<double>& probes = report.temperatures;
  if (!report.probe_trouble.empty()) return RigCheck{"probes", false, report.probe_trouble, false};
  if (std::ranges::all_of(probes, [](double t) { return std::isnan(t); })) return std::nullopt;
  std::string text;
  for (std::size_t k = 0; k < std::min(probes.size(), rig.system.size()); ++k)
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", rig.system.coil_names()[k],
                        std::isnan(probes[k]) ? "none" : fmt::format("{:.1f} °C", probes[k]));
  return RigCheck{"probes", true, text};
}

}  // namespace

RigCheck check_field(const Rig& rig) {
  const actuation::FieldGeneratorParams& field = rig.params.field;
  if (field.step_out_frequency && field.frequency > *field.step_out_frequency * (1 + 1e-9))
    return {"limits", false,
            fmt::format("the field turns {:.6g} times a second, the swarm follows up to {:.6g} "
                        "(field.step_out_frequency_hz)",
                        field.frequency, *field.step_out_frequency)};
  const double amplitude = rig.params.field.amplitude;
  const FieldLoad load = field_load(rig);
  if (!load.reached) return {"limits", false, "these coils cannot make every field that is needed"};
  if (load.scale < 1)
    return {"limits", false,
            fmt::format("the coils' limits weaken the field to {:.3g} mT, {:.6g} mT is meant",
                        load.scale * amplitude, amplitude)};
  return {"limits", true,
          fmt::format("the coils hold {:.6g} mT in every direction{}{}", amplitude,
                      how_long(rig, load), unlimited(rig))};
}

void require_field(const Rig& rig) {
  Issues issues;
  if (const RigCheck field = check_field(rig); !field.good)
    issues.add({"field.amplitude_mt", "field"}, field.answer);
  rig.keys.require_none(issues);
}

Issues missing_limits(const Rig& rig) {
  Issues issues;
  const auto& amplifiers = rig.system.amplifiers();
  const bool temperature =
      std::ranges::all_of(amplifiers, [](const actuation::AmplifierParams& amplifier) {
        return amplifier.max_temperature.has_value();
      });
  if (rig.limits_current && temperature) return issues;
  const char* const what = temperature          ? "current"
                           : rig.limits_current ? "temperature"
                                                : "current and the temperature";
  issues.add("coils",
             fmt::format("{} does not limit the {} of every coil: `drives` needs max_current_a and "
                         "max_temperature_degc, or give {}",
                         rig.params.coils, what, input_name("without_limits")));
  return issues;
}

std::vector<RigCheck> check_camera(vision::NewestFrame& camera, const Rig& rig,
                                   std::optional<double> rate, double seconds, const Stop& stop) {
  const Watched seen = watch(camera, seconds, stop);
  const vision::CameraStatus status = camera.status();
  const bool is_video = camera_kind(rig.params) == CameraKind::video;
  const bool runs = status.state == vision::CameraState::live ||
                    (is_video && status.state == vision::CameraState::ended);
  const bool timed = seen.gaps.count() > 0;
  const formats::Image& picture = seen.frame.frame.picture;
  std::vector<RigCheck> checks;
  checks.push_back(
      {"camera", timed && runs,
       fmt::format("{}, {} frames of {} × {} in {:.3g} s; {}", enum_name(status.state),
                   status.frames, picture.width, picture.height, seen.seconds,
                   timed ? fmt::format("between frames {} (p50 / p95 / p99)", quantiles(seen.gaps))
                         : "too few to measure the time between them")});
  const std::optional<double> meant =
      asked_camera_rate(rig.params) ? asked_camera_rate(rig.params) : rate;
  if (const double usual = seen.gaps.quantile(0.5); meant && timed) {
    std::string answer = fmt::format("{:.4g} ms apart as a rule, {:.6g} Hz means {:.4g}",
                                     1e3 * usual, *meant, 1e3 / *meant);
    if (rate && *rate < 0.99 * *meant)
      answer += fmt::format(": camera.rate_hz is {:.6g}, the camera's driver sets {:.6g} Hz",
                            *meant, *rate);
    checks.push_back({"frames", usual <= 1.1 / *meant, answer, false});
  }
  if (const double longest = seen.gaps.quantile(1); longest > rig.params.safety.max_frame_age)
    checks.push_back({"frames", false,
                      fmt::format("{:.3g} s apart, safety.max_frame_age_s is {:.6g}", longest,
                                  rig.params.safety.max_frame_age)});
  return checks;
}

std::vector<RigCheck> check_driver(actuation::CoilDriver& driver, const Rig& rig, double seconds,
                                   const Stop& stop) {
  Durations times;
  int exchanges = 0;
  int failures = 0;
  int misses = 0;  // in a row
  int resumed = 0;
  std::string trouble;
  std::string missing;
  const actuation::Capabilities device = driver.capabilities();
  const std::vector<double> no_currents(static_cast<std::size_t>(device.channels));
  const std::array<double, 3> no_field{};
  const actuation::CoilRequest nothing = actuation::constant_request(device, no_field, no_currents);
  const double rate = rig.params.drive_rate;
  double due = steady_seconds();
  for (const double end = due + seconds; due < end && !stop();) {
    std::this_thread::sleep_for(std::chrono::duration<double>(due - steady_seconds()));
    const double began = steady_seconds();
    const actuation::DriveStatus status = driver.drive(nothing);
    const double now = steady_seconds();
    if (++exchanges > 1) times.add(now - began);  // the first one also arms
    due = std::max(due + 1 / rate, now);
    misses = status == actuation::DriveStatus::no_answer ? misses + 1 : 0;
    failures += misses > 0;
    if (misses > 0) missing = driver.report().reason;
    resumed += status == actuation::DriveStatus::resumed;
    const bool unanswered = misses >= actuation::max_missed_answers;
    if (!actuation::trouble_text(status).empty() || unanswered)
      trouble = actuation::trouble_text(driver, status);
    if (status == actuation::DriveStatus::gone || unanswered) break;
  }
  const std::optional<RigCheck> probes = check_probes(driver.report(), rig);
  const actuation::StopReport zero = driver.stop();
  std::vector<RigCheck> checks;
  if (!trouble.empty()) checks.push_back({"driver", false, trouble});
  checks.push_back(
      {"driver", failures == 0,
       fmt::format("{} exchanges with all currents at zero, {} without an answer{}{}; {} (p50 / "
                   "p95 / p99)",
                   exchanges, failures, missing.empty() ? "" : ": ", missing, quantiles(times)),
       false});
  if (resumed > 0)
    checks.push_back({"driver", false,
                      fmt::format("the coils had switched off by themselves {} times", resumed)});
  if (probes) checks.push_back(*probes);
  checks.push_back({"stop", zero.good(),
                    !zero.confirmed ? "not confirmed"
                    : zero.good()   ? "confirmed"
                                    : zero.trouble});
  const double slow = times.quantile(0.99);
  checks.push_back({"pace", slow < 1 / rate,
                    fmt::format("an exchange takes {:.2f} ms at p99, drive_rate_hz {:.6g} allows "
                                "{:.2f}",
                                1e3 * slow, rate, 1e3 / rate),
                    false});
  return checks;
}

RigCheck check_computer(const Rig& rig, double seconds, const Stop& stop) {
  using Clock = std::chrono::steady_clock;
  const RealtimePriority priority(rig.params.realtime_priority);
  if (!priority.is_permitted())
    return {"computer", false,
            fmt::format("realtime_priority {} is not permitted to this user",
                        rig.params.realtime_priority)};
  const std::chrono::duration<double> period(1 / rig.params.drive_rate);
  Durations late;
  auto due = Clock::now();
  for (const auto end = due + std::chrono::duration<double>(seconds); due < end && !stop();) {
    due = std::max(due + std::chrono::duration_cast<Clock::duration>(period), Clock::now());
    std::this_thread::sleep_until(due);
    late.add(std::chrono::duration<double>(Clock::now() - due).count());
  }
  const double allowed = period.count() / 2;
  return {"computer", late.quantile(0.5) < allowed,
          fmt::format("threads are late by {} (p50 / p95 / p99){}", quantiles(late),
                      late.quantile(0.99) < allowed
                          ? ""
                          : fmt::format(", half a period of drive_rate_hz is {:.2f}: "
                                        "realtime_priority keeps other work away",
                                        1e3 * allowed)),
          false};
}

std::string quantiles(const Durations& times) {
  if (times.count() == 0) return "–";
  return fmt::format("{:.2f} / {:.2f} / {:.2f} ms", 1e3 * times.quantile(0.5),
                     1e3 * times.quantile(0.95), 1e3 * times.quantile(0.99));
}

}  // namespace microswarm::rig
