// SPDX-License-Identifier: Apache-2.0
#include "microswarm/rig/identify/recorded_response.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "microswarm/config/yaml.hpp"
#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/maths/angles.hpp"

namespace microswarm::rig {
namespace {

constexpr std::int64_t swarm_body = -1;

/// The gain's value: speed for a pitch, or distance per turn.
MeasuredValue gain_value(const RigParams& driven, const RigParams& file, const Estimate& gain) {
  const bool rolls = driven.field.kind == actuation::FieldKind::rolling;
  const double was = rolls ? driven.field.length_per_turn : driven.field.speed_per_pitch;
  return {.what = Quantity::gain,
          .key = rolls ? "field.length_per_turn_um" : "field.speed_per_pitch_um_per_s",
          .unit = rolls ? "µm" : "µm/s",
          .before = rolls ? file.field.length_per_turn : file.field.speed_per_pitch,
          .after = gain.value * was,
          .error = gain.error * was,
          .measured = fmt::format("{:.4g} ± {:.2g} times", gain.value, gain.error)};
}

}  // namespace

RecordedResponse::RecordedResponse(const experiment::Record& record) {
  const experiment::RigLog& log = record.rig_log;
  if (log.empty()) throw InputError("the record is not of a run on a rig");
  rig = read_yaml_text<RigParams>(log.rig_file, "/rig/file of the record");
  if (!log.turning.empty()) rig.field.frequency = log.turning.front();
  data.field = rig.field;
  std::size_t change = 0;
  double frequency = rig.field.frequency;
  for (const experiment::Frame& frame : record.frames) {
    // The change of a tick comes before its frame.
    for (; change < log.turning_at.size() && log.turning_at[change] <= frame.t; ++change)
      frequency = log.turning[change];
    const bool ends = &frame == &record.frames.back();
    data.commands.push_back(
        {frame.t, {frame.command.heading, ends ? 0 : frame.command.speed}, frequency});
  }
  for (std::size_t i = 0; i < log.seen_at.size(); ++i)
    if (log.bodies[i] == swarm_body) data.seen.push_back({log.seen_at[i], log.positions[i]});
}

Setting MeasuredValue::setting() const { return {key, fmt::format("{:.5g}", after)}; }

std::string step_out_text(const StepOut& sweep) {
  if (sweep.followed && sweep.lost)
    return fmt::format("{:.4g} to {:.4g} Hz", *sweep.followed, *sweep.lost);
  if (sweep.followed) return fmt::format("≥ {:.4g} Hz", *sweep.followed);
  if (sweep.lost) return fmt::format("< {:.4g} Hz", *sweep.lost);
  return {};
}

std::vector<MeasuredValue> measured_values(const RigParams& driven, const RigParams& file,
                                           const ResponseFit& fit, const StepOut& sweep) {
  std::vector<MeasuredValue> values{gain_value(driven, file, fit.gain)};
  values.push_back({.what = Quantity::angle,
                    .key = "field.heading_offset_deg",
                    .unit = "°",
                    .before = degrees(file.field.heading_offset),
                    .after = degrees(wrap(driven.field.heading_offset + fit.angle.value)),
                    .error = degrees(fit.angle.error),
                    .measured = fmt::format("{:+.1f} ± {:.1f}°", degrees(fit.angle.value),
                                            degrees(fit.angle.error))});
  values.push_back({.what = Quantity::delay,
                    .key = "delay_s",
                    .unit = "s",
                    .before = file.delay,
                    .after = std::max(0.0, fit.delay.value),
                    .error = fit.delay.error,
                    .measured = fmt::format("{:.0f} ± {:.0f} ms", 1e3 * fit.delay.value,
                                            1e3 * fit.delay.error)});
  if (sweep.followed && sweep.lost)
    values.push_back({.what = Quantity::step_out,
                      .key = "field.step_out_frequency_hz",
                      .unit = "Hz",
                      .before = file.field.step_out_frequency,
                      .after = *sweep.followed,
                      .measured = step_out_text(sweep)});
  return values;
}

}  // namespace microswarm::rig
