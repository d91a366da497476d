// SPDX-License-Identifier: Apache-2.0
// Guided measurement of the coils' fields for `rig calibrate --measure`.
#include "rig/calibrate/measure.hpp"
#include "rig/rig_settings.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <thread>

#include "microswarm/actuation/coils/measurement_plan.hpp"
#include "microswarm/actuation/coils/probe_file.hpp"
#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/text/lines.hpp"
#include "microswarm/core/text/text.hpp"
#include "microswarm/rig/runtime/manual_drive.hpp"
#include "rig/calibrate/probe_positions.hpp"
#include "rig/keys/answer_line.hpp"
#include "rig/rig.hpp"
#include "support/options.hpp"

namespace microswarm::cli {
namespace {

constexpr double max_settling = 10;      // after the ramp, until the currents are reached [s]
constexpr double max_arriving = 1;       // time for which a device may report other currents [s]
constexpr double probe_silence = 5;      // [s]
constexpr double max_typed_field = 1e4;  // [mT]
constexpr double weakened = 1 - 1e-6;
constexpr int max_attempts = 5;         // consecutive, without operator, measurement or end
constexpr double reversed_share = 0.1;  // share of the expected field, with opposite sign
constexpr double resolution =
    2e-3;  // share of the full scale by which a device may differ from the plan

/// Throws InputError if the planned measurements would not determine the fit.
void require_determined(const std::vector<MeasurementStep>& steps, const CoilSystem& system,
                        const FitOptions& fit) {
  FieldMeasurements planned{.file = "--positions", .coils = system.coil_names()};
  for (const MeasurementStep& step : steps)
    planned.rows.push_back({step.currents, step.position, Eigen::Vector3d::Zero(), 0});
  fit_matrix(planned, fit);
}

/// Parses a typed field; on failure `why` is the reason.
std::optional<Eigen::Vector3d> field_in(std::string line, std::string& why) {
  std::ranges::replace_if(
      line, [](char c) { return c == ',' || c == '\t'; }, ' ');
  const std::vector<std::string_view> cells = words(line);
  Eigen::Vector3d field;
  for (std::size_t k = 0; k < cells.size() && cells.size() == 3; ++k) {
    const std::optional<double> value = parse_number(cells[k]);
    if (!value || std::abs(*value) > max_typed_field) {
      why = fmt::format("{} is no field of at most {:.6g} mT", quote(cells[k]), max_typed_field);
      return std::nullopt;
    }
    field[static_cast<Eigen::Index>(k)] = *value;
  }
  if (cells.size() == 3) return field;
  why = fmt::format("three numbers are needed, Bx By Bz in mT, not {}", quote(line));
  return std::nullopt;
}

/// Outcome of a step.
enum class Outcome { measured, repeat, back, unanswered, weak, no_current, ended, failed };

class Guide {
 public:
  Guide(const Rig& rig, const MeasureOptions& o, MeasurementLog& log, const Context& context)
      : rig_(rig),
        o_(o),
        log_(log),
        stop_(context.stop),
        answers_(!o.probe.empty()),
        tolerance_(resolution * full_scale_of(rig.params)) {
    if (!o.probe.empty()) probe_.emplace(o.probe);
  }

  int make(const std::vector<MeasurementStep>& steps);

 private:
  enum class Moved { there, back, ended };
  Moved move_to(const Eigen::Vector3d& position);
  std::optional<std::string> wait_for_line();
  Outcome hold(const MeasurementStep& step, const std::string& what);
  void look(const ManualMoment& moment);
  void settle(double t);
  void tell_limits() const;
  void tell_reversal() const;
  std::optional<Eigen::Vector3d> expected() const;
  std::string question() const;
  void take_answer();
  void take_rows(double t);
  void finish(Outcome outcome) { outcome_ = outcome; }
  std::string words_for(const MeasurementStep& step) const;

  const Rig& rig_;
  const MeasureOptions& o_;
  MeasurementLog& log_;
  Stop stop_;
  AnswerLine answers_;
  double tolerance_;  // between planned and reported currents [A]
  std::optional<ProbeFile> probe_;
  std::unique_ptr<Bench> bench_;
  std::optional<Eigen::Vector3d> place_;  // of the probe

  // Of the step that is held:
  const MeasurementStep* step_ = nullptr;
  std::string what_;
  std::optional<Outcome> outcome_;
  std::optional<double> settled_, newest_row_;  // [s]
  std::vector<Eigen::Vector3d> readings_;
  Eigen::VectorXd currents_;  // as the device has them [A]
  StopReport zero_;
  std::string trouble_;
};

/// "no current" or "2 A in coil x".
std::string Guide::words_for(const MeasurementStep& step) const {
  std::vector<std::string> parts;
  for (Eigen::Index k = 0; k < step.currents.size(); ++k)
    if (step.currents[k] != 0)
      parts.push_back(fmt::format("{:.4g} A in {}", step.currents[k],
                                  rig_.system.coil_names()[static_cast<std::size_t>(k)]));
  return parts.empty() ? "no current" : fmt::format("{}", fmt::join(parts, ", "));
}

/// Waits for the next line with the coils at zero; nothing at the end.
std::optional<std::string> Guide::wait_for_line() {
  while (!stop_()) {
    if (auto line = answers_.poll()) return std::string(trimmed(*line));
    if (answers_.ended()) return std::nullopt;
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  return std::nullopt;
}

Guide::Moved Guide::move_to(const Eigen::Vector3d& position) {
  if (place_ && *place_ == position) return Moved::there;
  const bool asks = answers_.is_terminal() || place_ || position != rig_.system.centre();
  for (int attempt = 0; asks; ++attempt) {
    if (attempt == max_attempts && !answers_.is_terminal()) return Moved::ended;
    answers_.ask(
        fmt::format("probe to {} µm, then Enter (b: back, q: end): ", triple_text(position)));
    const auto line = wait_for_line();
    if (!line || *line == "q") return Moved::ended;
    if (*line == "b") return Moved::back;
    if (line->empty()) break;
    note("Enter, b or q is needed, not {}\n", quote(*line));
  }
  place_ = position;
  return Moved::there;
}

void Guide::take_answer() {
  const auto line = answers_.poll();
  if (!line && answers_.ended()) return finish(Outcome::ended);
  if (!line) return;
  const std::string_view text = trimmed(*line);
  if (text == "q") return finish(Outcome::ended);
  if (text == "r") return finish(Outcome::repeat);
  if (text == "b") return finish(Outcome::back);
  std::string why;
  if (const auto field = field_in(std::string(text), why)) {
    readings_ = {*field};
    return finish(Outcome::measured);
  }
  note("{}\n", why);
  answers_.ask(question());
}

void Guide::take_rows(double t) {
  const std::size_t before = readings_.size();
  probe_->read(readings_);
  if (readings_.size() > before) newest_row_ = t;
  if (t - newest_row_.value_or(*settled_) > probe_silence)
    throw HardwareError(fmt::format("{}: no new row in {:.6g} s after {}", probe_->name(),
                                    probe_silence, quote(probe_->last_row())));
  if (!readings_.empty() && t - *settled_ >= o_.dwell) finish(Outcome::measured);
}

/// Expected field of the flowing currents, by the coils' current file.
std::optional<Eigen::Vector3d> Guide::expected() const {
  if (!rig_.system.in_workspace(step_->position)) return std::nullopt;
  const bool planned = (currents_ - step_->currents).cwiseAbs().maxCoeff() <= tolerance_;
  return rig_.system.at(step_->position).field_of(planned ? step_->currents : currents_);
}

std::string Guide::question() const {
  std::string text = what_;
  if (const auto b = expected()) {
    const auto shown = [&](Eigen::Index k) { return tidy((*b)[k], 1e3 * b->norm()); };
    text += fmt::format(", ({:.4g}, {:.4g}, {:.4g}) mT expected", shown(0), shown(1), shown(2));
  }
  return text + ". Bx By Bz in mT: ";
}

void Guide::tell_limits() const {
  std::vector<std::string> limited;
  for (Eigen::Index k = 0; k < currents_.size(); ++k)
    if (std::abs(step_->currents[k]) - std::abs(currents_[k]) > tolerance_)
      limited.push_back(fmt::format("{} to {:.4g} A of {:.4g} A",
                                    rig_.system.coil_names()[static_cast<std::size_t>(k)],
                                    currents_[k], step_->currents[k]));
  if (!limited.empty()) note("note: the device limits {}\n", fmt::join(limited, ", "));
}

/// Warns if the field along the main axis has the opposite sign of the expected one.
void Guide::tell_reversal() const {
  const auto b = expected();
  if (!b || step_->currents.isZero(0)) return;
  Eigen::Index k = 0;
  const double most = b->cwiseAbs().maxCoeff(&k);
  const double got = reading_of(readings_).mean[k];
  if (got * (*b)[k] < 0 && std::abs(got) > reversed_share * most)
    note("note: B{} expected {:+.4g} mT, got {:.4g} mT: a reversed coil or probe?\n", "xyz"[k],
         (*b)[k], got);
}

/// Detects settled currents after the ramp: as planned, or other ones for long enough.
void Guide::settle(double t) {
  const bool there = (currents_ - step_->currents).cwiseAbs().maxCoeff() <= tolerance_;
  if (!there && t < o_.ramp + o_.settle + max_arriving) return;
  if (!there && currents_.cwiseAbs().maxCoeff() <= tolerance_ / 4)
    return finish(Outcome::no_current);
  settled_ = t;
  tell_limits();
  if (probe_)
    probe_->skip_to_end();
  else
    answers_.ask(question());
}

/// Called after each output to the coils.
void Guide::look(const ManualMoment& moment) {
  bench_->temperatures = moment.output.temperatures;
  if (bench_->kept) bench_->kept->take(bench_->temperatures);
  if (outcome_ || !settled_ || probe_) answers_.watch();
  if (outcome_) return;
  const bool full = moment.output.scale >= weakened;
  const std::vector<double>& reported = bench_->driver->report().currents;
  currents_ = Eigen::Map<const Eigen::VectorXd>(reported.data(), currents_.size());
  if (!settled_) {
    if (moment.t >= o_.ramp + o_.settle && full)
      settle(moment.t);
    else if (moment.t > o_.ramp + o_.settle + max_settling)
      finish(Outcome::weak);
    return;
  }
  if (!full) return finish(Outcome::weak);
  if (probe_)
    take_rows(moment.t);
  else
    take_answer();
}

/// Holds the currents until the answer or a timeout.
Outcome Guide::hold(const MeasurementStep& step, const std::string& what) {
  step_ = &step;
  what_ = what;
  outcome_.reset();
  settled_.reset();
  newest_row_.reset();
  readings_.clear();
  trouble_.clear();
  currents_ = Eigen::VectorXd::Zero(step.currents.size());
  const ManualCommand command{.wanted = step.currents,
                              .seconds = 2 * o_.ramp + o_.settle + o_.hold,
                              .ramp = o_.ramp,
                              .enough = [this] { return outcome_.has_value(); }};
  const ManualResult result = drive_by_hand(
      rig_, *bench_->driver, command, bench_->temperatures,
      [&](const ManualMoment& moment) { look(moment); }, stop_);
  zero_ = result.zero;
  trouble_ = result.why;
  // A measurement counts even if something fails while the currents ramp down.
  if (outcome_ == Outcome::measured) {
    tell_reversal();
    log_.add(currents_, step.currents, step.position, reading_of(readings_));
  }
  if (!trouble_.empty() || !zero_.good()) return Outcome::failed;
  if (result.status == Status::stopped) return Outcome::ended;
  return outcome_.value_or(Outcome::unanswered);
}

int Guide::make(const std::vector<MeasurementStep>& steps) {
  const auto left = [&] { return missing_steps(steps, log_.measured().rows); };
  std::vector<MeasurementStep> missing = left();
  if (missing.empty()) return ok;
  bench_ = std::make_unique<Bench>(rig_, o_.coils);
  note("{} measurements of {} are to be made. {}: coils to zero at once\n", missing.size(),
       steps.size(), probe_ ? "Space, e or Esc" : "Esc");
  if (!probe_) note("b: back, r: again, q: end; what was measured is kept\n");
  bool goes_on = true;
  std::size_t fewest = missing.size();
  int attempts = 0;
  while (goes_on && !missing.empty()) {
    const MeasurementStep& step = missing.front();
    const Moved moved = move_to(step.position);
    const std::string what =
        fmt::format("{}/{}: {}", steps.size() - missing.size() + 1, steps.size(), words_for(step));
    if (probe_ && moved == Moved::there) note("{}\n", what);
    const Outcome outcome = moved == Moved::there  ? hold(step, what)
                            : moved == Moved::back ? Outcome::back
                                                   : Outcome::ended;
    switch (outcome) {
      case Outcome::measured:
      case Outcome::repeat:
        break;
      case Outcome::back:
        log_.remove_last();
        break;
      case Outcome::unanswered: {
        answers_.ask(
            fmt::format("\nno answer in {:.6g} s: the coils are at zero. Enter: again: ", o_.hold));
        const auto line = wait_for_line();
        goes_on = line && *line != "q";
        break;
      }
      case Outcome::weak:
        throw InputError(fmt::format("the limits of the coils weaken {}: give a smaller --current",
                                     words_for(step)));
      case Outcome::no_current:
        throw HardwareError(
            fmt::format("the device reports 0 A for {}: nothing can be measured", words_for(step)));
      case Outcome::failed:
        if (!trouble_.empty()) note("\nmicroswarm: {}\n", trouble_);
        note_zero(zero_);
        [[fallthrough]];
      case Outcome::ended:
        goes_on = false;
        break;
    }
    if (stop_()) goes_on = false;
    const bool failed = outcome == Outcome::failed;
    const std::string words = words_for(step);
    missing = left();
    const bool person = answers_.is_terminal() && outcome != Outcome::measured;
    attempts = person || missing.size() < fewest ? 0 : attempts + 1;
    fewest = person ? missing.size() : std::min(fewest, missing.size());
    if (attempts == max_attempts) {
      note("\n{} attempts without a measurement, the last with {}\n", attempts, words);
      goes_on = false;
    }
    if (failed || (!goes_on && !missing.empty())) {
      note("\n{} of {} measurements are made; the same command goes on\n",
           steps.size() - missing.size(), steps.size());
      return failed ? hardware : not_reached;
    }
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

int measure(const Rig& rig, const MeasureOptions& o, const FitOptions& fit, const std::string& file,
            const Context& context) {
  if (!o.probe.empty() && o.dwell > o.hold) throw InputError("--dwell: is longer than --hold");
  const std::vector<MeasurementStep> steps =
      measurement_plan(rig.system, {.positions = positions_of(o.positions, rig.system),
                                    .current = o.current,
                                    .levels = o.levels,
                                    .pairs = o.pairs});
  require_determined(steps, rig.system, fit);
  MeasurementLog log(file, rig.system.coil_names());
  Guide guide(rig, o, log, context);
  return guide.make(steps);
}

}  // namespace microswarm::cli
