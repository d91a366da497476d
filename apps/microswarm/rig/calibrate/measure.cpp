// SPDX-License-Identifier: Apache-2.0
// Guided measurement of the coils' fields for `rig calibrate --measure`.
#include "rig/calibrate/measure.hpp"
#include "rig/commissioner.hpp"

#include <fmt/ranges.h>

#include <chrono>
#include <memory>
#include <thread>
#include <utility>

#include "microswarm/actuation/amplifiers/coil_heat.hpp"
#include "microswarm/actuation/coils/measurement_plan.hpp"
#include "microswarm/actuation/coils/probe_file.hpp"
#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/text/lines.hpp"
#include "microswarm/core/text/text.hpp"
#include "microswarm/rig/runtime/measurement_run.hpp"
#include "rig/calibrate/field_readers.hpp"
#include "rig/calibrate/probe_positions.hpp"
#include "rig/keys/answer_line.hpp"
#include "rig/rig.hpp"
#include "rig/rig_settings.hpp"
#include "support/options.hpp"

namespace microswarm::cli {
namespace {

/// Throws InputError if the planned measurements would not determine the fit.
void require_determined(const std::vector<actuation::MeasurementStep>& steps,
                        const actuation::CoilSystem& system, const actuation::FitOptions& fit) {
  actuation::FieldMeasurements planned{.file = "--positions", .coils = system.coil_names()};
  for (const actuation::MeasurementStep& step : steps)
    planned.rows.push_back({step.currents, step.position, Eigen::Vector3d::Zero(), 0});
  actuation::fit_matrix(planned, fit);
}

class Dialogue {
 public:
  Dialogue(const rig::Rig& rig, const MeasureOptions& o, rig::MeasurementRun& run,
           const Context& context)
      : rig_(rig), o_(o), run_(run), stop_(context.stop), answers_(!o.probe.empty()) {
    if (!o.probe.empty()) probe_.emplace(o.probe);
  }
  /// Makes the missing measurements; an exit code.
  int make();

 private:
  std::optional<std::string> wait_for_line();
  std::optional<rig::MeasurementOutcome> move_to(const Eigen::Vector3d& position);
  rig::Measurement measure(const actuation::MeasurementStep& step);
  rig::Measurement drive(const actuation::MeasurementStep& step, rig::FieldReader& reader);
  bool goes_on_after(const rig::Measurement& made, const actuation::MeasurementStep& step);
  std::optional<rig::Measurement> compare_with_clamp(const actuation::MeasurementStep& step);
  bool is_doubted(const rig::Measurement& made, const actuation::MeasurementStep& step);
  std::string words_for(const actuation::MeasurementStep& step) const;

  const rig::Rig& rig_;
  const MeasureOptions& o_;
  rig::MeasurementRun& run_;
  Stop stop_;
  AnswerLine answers_;
  std::optional<actuation::ProbeFile> probe_;
  std::unique_ptr<Bench> bench_;
  std::optional<Eigen::Vector3d> position_;  // of the probe
  std::optional<Eigen::Vector3d> doubted_;   // last reading of this step [mT]
  bool asks_for_clamp_ = false;
  int doubts_ = 0;  // readings of this step in doubt
};

/// "no current" or "2 A in coil x".
std::string Dialogue::words_for(const actuation::MeasurementStep& step) const {
  std::vector<std::string> parts;
  for (Eigen::Index k = 0; k < step.currents.size(); ++k)
    if (step.currents[k] != 0)
      parts.push_back(fmt::format("{:.4g} A in {}", step.currents[k],
                                  rig_.system.coil_names()[static_cast<std::size_t>(k)]));
  return parts.empty() ? "no current" : fmt::format("{}", fmt::join(parts, ", "));
}

/// Waits for the next line with the coils at zero; nothing at the end.
std::optional<std::string> Dialogue::wait_for_line() {
  while (!stop_()) {
    if (auto line = answers_.poll()) return std::string(trimmed(*line));
    if (answers_.ended()) return std::nullopt;
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  return std::nullopt;
}

/// Asks for the probe at a position; the step's outcome if it is not moved there.
std::optional<rig::MeasurementOutcome> Dialogue::move_to(const Eigen::Vector3d& position) {
  if (position_ && *position_ == position) return std::nullopt;
  const bool asks = answers_.is_terminal() || position_ || position != rig_.system.centre();
  for (int attempt = 0; asks; ++attempt) {
    if (attempt == rig::MeasurementRun::max_attempts && !answers_.is_terminal())
      return rig::MeasurementOutcome::ended;
    answers_.ask(
        fmt::format("probe to {} µm, then Enter (b: back, q: end): ", triple_text(position)));
    const auto line = wait_for_line();
    if (!line || *line == "q") return rig::MeasurementOutcome::ended;
    if (*line == "b") return rig::MeasurementOutcome::back;
    if (line->empty()) break;
    note("Enter, b or q is needed, not {}\n", quote(*line));
  }
  position_ = position;
  return std::nullopt;
}

rig::Measurement Dialogue::measure(const actuation::MeasurementStep& step) {
  if (const auto end = move_to(step.position)) return {.outcome = *end};
  if (asks_for_clamp_ && !step.currents.isZero(0))
    if (const auto other = compare_with_clamp(step)) return *other;
  const std::string what = fmt::format("{}/{}: {}", run_.made() + 1, run_.size(), words_for(step));
  if (probe_) note("{}\n", what);
  const std::vector<std::string> coils = rig_.system.coil_names();
  TypedField typed(answers_, coils, what);
  std::optional<LoggedField> logged;
  if (probe_) logged.emplace(answers_, coils, *probe_, o_.dwell);
  return drive(step, logged ? static_cast<rig::FieldReader&>(*logged) : typed);
}

rig::Measurement Dialogue::drive(const actuation::MeasurementStep& step, rig::FieldReader& reader) {
  rig::Measurement made = rig::measure_field(
      rig_, *bench_->driver, step, {o_.ramp, o_.settle, o_.hold}, reader, bench_->temperatures,
      [this](const actuation::CoilOutput& output) {
        bench_->temperatures = output.temperatures;
        if (bench_->kept) bench_->kept->take(bench_->temperatures);
      },
      stop_);
  if (bench_->kept) bench_->kept->take(made.zero);
  return made;
}

/// Reports the outcome of a step, and asks where that needs an answer. False ends the measurement.
bool Dialogue::goes_on_after(const rig::Measurement& made, const actuation::MeasurementStep& step) {
  using enum rig::MeasurementOutcome;
  switch (made.outcome) {
    case measured:
    case repeat:
    case back:
      return true;
    case unanswered: {
      answers_.ask(
          fmt::format("\nno answer in {:.6g} s: the coils are at zero. Enter: again: ", o_.hold));
      const auto line = wait_for_line();
      return line && *line != "q";
    }
    case weak:
      throw InputError(fmt::format("the limits of the coils weaken {}: give a smaller --current",
                                   words_for(step)));
    case no_current:
      throw HardwareError(
          fmt::format("the device reports 0 A for {}: nothing can be measured", words_for(step)));
    case failed:
      if (!made.why.empty()) note("\nmicroswarm: {}\n", made.why);
      note_zero(made.zero);
      return false;
    case ended:
      return false;
  }
  return false;
}

/// Asks once for the current of a step by a clamp meter, which no program can know: fields, heat
/// and every limit follow from it. Throws InputError if it is another than the device reports.
/// Returns the outcome that is none of these.
std::optional<rig::Measurement> Dialogue::compare_with_clamp(
    const actuation::MeasurementStep& step) {
  constexpr double tolerance = 0.1;  // share of the current
  TypedCurrent typed(answers_, rig_.system.coil_names(), words_for(step));
  rig::Measurement made = drive(step, typed);
  made.reading.reset();  // of no field
  if (made.outcome != rig::MeasurementOutcome::measured) return made;
  asks_for_clamp_ = false;
  if (!typed.current()) return std::nullopt;
  Eigen::Index coil = 0;
  const double reported = made.currents.cwiseAbs().maxCoeff(&coil);
  const double shown = std::abs(*typed.current());
  if (std::abs(shown - reported) <= tolerance * reported) {
    commission(rig_.file,
               {rig::commissioning_entry(
                   rig::Quantity::current, fmt::format("{:.3g} A of {:.3g} A", shown, reported),
                   commissioner(o_.by), rig::key_fingerprint(rig_, rig::Quantity::current))});
    return std::nullopt;
  }
  // More current than was reckoned with has heated more, too.
  if (shown > reported && bench_->kept) {
    bench_->kept->take(actuation::hottest(rig_.system.amplifiers()));
    bench_->kept->take(made.zero);
  }
  const double full_scale = rig::driver_full_scale(rig_.params);
  throw InputError(fmt::format(
      "{:.4g} A flow in {} where the device reports {:.4g} A: driver.full_scale_a is {:.4g}, must "
      "be {:.3g}; until then every current, field and temperature is wrong by this factor",
      shown, rig_.system.coil_names()[static_cast<std::size_t>(coil)], reported, full_scale,
      full_scale * shown / reported));
}

/// Whether the reading is to be made again, since the coil file lets expect another. One that is
/// much the same again is taken.
bool Dialogue::is_doubted(const rig::Measurement& made, const actuation::MeasurementStep& step) {
  constexpr double same = 0.1;  // share of the reading
  constexpr int max_doubts = 3;
  if (made.outcome != rig::MeasurementOutcome::measured) {
    doubted_.reset();
    doubts_ = 0;
    return false;
  }
  const Eigen::Vector3d mean = made.reading->mean;
  const std::string doubt = rig::reading_doubt(rig_, made, step, run_.background());
  const auto before = std::exchange(doubted_, std::nullopt);
  if (doubt.empty()) {
    doubts_ = 0;
    return false;
  }
  if (++doubts_ >= max_doubts || (before && (*before - mean).norm() <= same * mean.norm())) {
    note("note: {}: {}; taken after {} readings\n", words_for(step), doubt, doubts_);
    doubts_ = 0;
    return false;
  }
  note("note: ({:.4g}, {:.4g}, {:.4g}) mT for {} is {}. Once more\n", mean[0], mean[1], mean[2],
       words_for(step), doubt);
  doubted_ = mean;
  return true;
}

int Dialogue::make() {
  if (!run_.next()) return ok;
  bench_ = std::make_unique<Bench>(rig_, o_.coils);
  note("{} measurements of {} are to be made. {}: coils to zero at once\n",
       run_.size() - run_.made(), run_.size(), probe_ ? "Space, e or Esc" : "Esc");
  if (!probe_) note("b: back, r: again, q: end; what was measured is kept\n");
  asks_for_clamp_ = !probe_ && answers_.is_terminal() && run_.made() <= 1;
  while (run_.next()) {
    const actuation::MeasurementStep step = *run_.next();
    const rig::Measurement made = measure(step);
    if (is_doubted(made, step)) continue;
    run_.take(made, answers_.is_terminal());
    bool goes_on = goes_on_after(made, step) && !stop_();
    if (run_.attempts() == rig::MeasurementRun::max_attempts) {
      note("\n{} attempts without a measurement, the last with {}\n", run_.attempts(),
           words_for(step));
      goes_on = false;
    }
    const bool failed = made.outcome == rig::MeasurementOutcome::failed;
    if (!failed && (goes_on || !run_.next())) continue;
    note("\n{} of {} measurements are made; run the same command again for the rest\n", run_.made(),
         run_.size());
    return failed ? hardware : not_reached;
  }
  return ok;
}

}  // namespace

void add_measure_options(Command cmd, MeasureOptions& o) {
  const Option measure =
      cmd.add_option("--measure", o.rig, "Drive the coils of this rig and measure what FILE lacks")
          .type_name("RIG");
  cmd.add_option("--positions", o.positions,
                 "Positions of the probe in µm, or a CSV file with x_um,y_um,z_um")
      .type_name("X,Y,Z;…")
      .needs(measure);
  cmd.add_option("--current", o.current, "Largest current in A")
      .type_name("A")
      .default_text("80 % of what each coil can hold")
      .check(number(1e-6, 1e6))
      .needs(measure);
  cmd.add_option("--levels", o.levels, "Currents of each sign for each coil")
      .type_name("NUMBER")
      .check(whole(1, 20))
      .needs(measure);
  cmd.add_flag("--pairs", o.pairs, "Also each coil together with the next one").needs(measure);
  cmd.add_option("--hold", o.hold, "Longest time a current waits for an answer")
      .type_name("SECONDS")
      .check(number(0.1, 3600))
      .needs(measure);
  cmd.add_option("--ramp", o.ramp, "Time of each ramp")
      .type_name("SECONDS")
      .check(number(0, 100))
      .needs(measure);
  cmd.add_option("--settle", o.settle, "Time after the ramp until the field counts")
      .type_name("SECONDS")
      .check(number(0, 600))
      .needs(measure);
  const Option probe =
      cmd.add_option("--probe", o.probe, "CSV file of a probe's logger with bx_mt, by_mt, bz_mt")
          .type_name("CSV")
          .needs(measure);
  cmd.add_option("--dwell", o.dwell, "Time over which the probe's rows are averaged")
      .type_name("SECONDS")
      .check(number(0.01, 600))
      .needs(probe);
  add_coil_options(cmd, o.coils);
  add_rig_settings(cmd, "--set", o.settings).needs(measure);
}

int measure(const rig::Rig& rig, const MeasureOptions& o, const actuation::FitOptions& fit,
            const std::string& file, const Context& context) {
  if (!o.probe.empty() && o.dwell > o.hold) throw InputError("--dwell: is longer than --hold");
  const std::vector<actuation::MeasurementStep> steps = actuation::measurement_plan(
      rig.system, {.positions = probe_positions(o.positions, rig.system),
                   .current = o.current,
                   .levels = o.levels,
                   .pairs = o.pairs});
  require_determined(steps, rig.system, fit);
  actuation::MeasurementLog log(file, rig.system.coil_names());
  rig::MeasurementRun run(steps, log);
  return Dialogue(rig, o, run, context).make();
}

}  // namespace microswarm::cli
