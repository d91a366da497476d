// SPDX-License-Identifier: Apache-2.0
// Guided measurement of the coils' fields for `rig calibrate --measure`.
#include "rig/measure.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <thread>

#include "microswarm/actuation/coils/measurement_plan.hpp"
#include "microswarm/actuation/coils/probe_file.hpp"
#include "microswarm/actuation/coils/text_rows.hpp"
#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/text/file.hpp"
#include "microswarm/core/text/text.hpp"
#include "microswarm/rig/runtime/manual_drive.hpp"
#include "rig/answer_line.hpp"
#include "rig/rig.hpp"
#include "support/options.hpp"

namespace microswarm::cli {
namespace {

constexpr double max_settling = 10;      // beyond the ramp, until the currents are there [s]
constexpr double probe_silence = 5;      // [s]
constexpr double max_typed_field = 1e4;  // [mT]
constexpr double weakened = 1 - 1e-6;
constexpr std::size_t max_positions = 1000;
constexpr double resolution =
    2e-3;  // of the full scale, in which a device may differ from the plan

std::vector<Eigen::Vector3d> positions_in(const std::string& file) {
  const std::string text = read_file(file, 1U << 20);
  TextRows rows(text, file);
  if (!rows.next() || rows.pieces(',') != std::vector<std::string_view>{"x_um", "y_um", "z_um"})
    rows.fail("the header must be x_um,y_um,z_um");
  std::vector<Eigen::Vector3d> places;
  while (rows.next()) {
    const std::vector<std::string_view> cells = rows.pieces(',');
    if (cells.size() != 3) rows.fail(fmt::format("{} numbers, 3 expected", cells.size()));
    Eigen::Vector3d place;
    for (std::size_t k = 0; k < 3; ++k)
      place[static_cast<Eigen::Index>(k)] = rows.number(cells[k], "position");
    if (place.cwiseAbs().maxCoeff() > max_place)
      rows.fail(fmt::format("position {} is beyond {:.6g} µm", triple_text(place), max_place));
    places.push_back(place);
  }
  if (places.empty()) rows.fail("no positions follow the header");
  return places;
}

/// The positions in "X,Y,Z;X,Y,Z" or in a file; the rig's centre without any.
std::vector<Eigen::Vector3d> positions_of(const std::string& given, const CoilSystem& system) {
  if (given.empty()) return {system.centre()};
  std::vector<Eigen::Vector3d> places;
  for (const std::string_view one : split(given, ';')) {
    const std::vector<double> v = numbers(one);
    if (v.size() != 3) break;
    places.emplace_back(v[0], v[1], v[2]);
    if (places.back().cwiseAbs().maxCoeff() > max_place)
      throw InputError(fmt::format("--positions: {} is beyond {:.6g} µm", quote(one), max_place));
  }
  if (places.size() != split(given, ';').size()) places = positions_in(given);
  if (places.size() > max_positions)
    throw InputError(
        fmt::format("--positions: {} positions, at most {}", places.size(), max_positions));
  return places;
}

/// Throws InputError if what is planned would not determine the fit.
void require_determined(const std::vector<MeasurementStep>& steps, const CoilSystem& system,
                        const FitOptions& fit) {
  FieldMeasurements planned{.file = "--positions", .coils = system.coil_names()};
  for (const MeasurementStep& step : steps)
    planned.rows.push_back({step.currents, step.place, Eigen::Vector3d::Zero(), 0});
  fit_matrix(planned, fit);
}

/// A field that was typed, or why it is none.
std::optional<Eigen::Vector3d> field_in(std::string line, std::string& why) {
  std::ranges::replace_if(
      line, [](char c) { return c == ',' || c == ';' || c == '\t'; }, ' ');
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

/// What became of a step.
enum class Outcome { measured, repeat, back, unanswered, weak, ended, failed };

class Guide {
 public:
  Guide(const Rig& rig, const MeasureOptions& o, MeasurementLog& log, const Context& context)
      : rig_(rig), o_(o), log_(log), stop_(context.stop), answers_(!o.probe.empty()) {
    if (!o.probe.empty()) probe_.emplace(o.probe);
  }

  int make(const std::vector<MeasurementStep>& steps, double tolerance);

 private:
  enum class Moved { there, back, ended };
  Moved move_to(const Eigen::Vector3d& place);
  std::optional<std::string> wait_for_line();
  Outcome hold(const MeasurementStep& step, const std::string& what);
  void look(const ManualMoment& moment, const std::string& question);
  void take_answer(const std::string& question);
  void take_rows(double t);
  void finish(Outcome outcome) { outcome_ = outcome; }
  std::string words_for(const MeasurementStep& step) const;

  const Rig& rig_;
  const MeasureOptions& o_;
  MeasurementLog& log_;
  Stop stop_;
  AnswerLine answers_;
  std::optional<ProbeFile> probe_;
  std::unique_ptr<Bench> bench_;
  std::optional<Eigen::Vector3d> place_;  // of the probe

  // Of the step that is held:
  std::optional<Outcome> outcome_;
  std::optional<double> settled_, newest_row_;  // [s]
  std::vector<Eigen::Vector3d> readings_;
  Eigen::VectorXd currents_;  // as the device has them [A]
  bool zero_confirmed_ = true;
  std::string trouble_;
  std::string stop_trouble_;
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

/// The next line, with the coils at zero; nothing when it ends.
std::optional<std::string> Guide::wait_for_line() {
  while (!stop_()) {
    if (auto line = answers_.poll()) return std::string(trimmed(*line));
    if (answers_.ended()) return std::nullopt;
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  return std::nullopt;
}

Guide::Moved Guide::move_to(const Eigen::Vector3d& place) {
  if (place_ && *place_ == place) return Moved::there;
  const bool asks = answers_.is_terminal() || place_ || place != rig_.system.centre();
  while (asks) {
    answers_.ask(fmt::format("probe to {} µm, then Enter (b: back, q: end): ", triple_text(place)));
    const auto line = wait_for_line();
    if (!line || *line == "q") return Moved::ended;
    if (*line == "b") return Moved::back;
    if (line->empty()) break;
    note("Enter, b or q is needed, not {}\n", quote(*line));
  }
  place_ = place;
  return Moved::there;
}

void Guide::take_answer(const std::string& question) {
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
  answers_.ask(question);
}

void Guide::take_rows(double t) {
  const std::size_t before = readings_.size();
  probe_->read(readings_);
  if (readings_.size() > before) newest_row_ = t;
  if (t - newest_row_.value_or(*settled_) > probe_silence)
    throw HardwareError(fmt::format("{}: no new row in {:.6g} s", probe_->name(), probe_silence));
  if (!readings_.empty() && t - *settled_ >= o_.dwell) finish(Outcome::measured);
}

/// After each output to the coils.
void Guide::look(const ManualMoment& moment, const std::string& question) {
  bench_->temperatures = moment.output.temperatures;
  if (bench_->kept) bench_->kept->take(bench_->temperatures);
  if (outcome_ || !settled_ || probe_) answers_.watch();
  if (outcome_) return;
  const bool full = moment.output.scale >= weakened;
  if (!settled_) {
    if (moment.t >= o_.ramp + o_.settle && full) {
      settled_ = moment.t;
      if (probe_)
        probe_->skip_to_end();
      else
        answers_.ask(question);
    } else if (moment.t > o_.ramp + o_.settle + max_settling) {
      finish(Outcome::weak);
    }
    return;
  }
  if (!full) return finish(Outcome::weak);
  const auto reported = bench_->driver->currents();
  currents_ = Eigen::Map<const Eigen::VectorXd>(reported.data(), currents_.size());
  if (probe_)
    take_rows(moment.t);
  else
    take_answer(question);
}

/// Holds the currents until there is an answer or the time is up.
Outcome Guide::hold(const MeasurementStep& step, const std::string& what) {
  outcome_.reset();
  settled_.reset();
  newest_row_.reset();
  readings_.clear();
  trouble_.clear();
  currents_ = Eigen::VectorXd::Zero(step.currents.size());
  std::string question = what;
  if (rig_.system.in_workspace(step.place)) {
    const Eigen::Vector3d b = rig_.system.at(step.place).field_of(step.currents);
    const auto shown = [&](Eigen::Index k) { return tidy(b[k], 1e3 * b.norm()); };
    question += fmt::format(", ({:.4g}, {:.4g}, {:.4g}) mT expected", shown(0), shown(1), shown(2));
  }
  question += ". Bx By Bz in mT: ";
  const ManualCommand command{.wanted = step.currents,
                              .seconds = 2 * o_.ramp + o_.settle + o_.hold,
                              .ramp = o_.ramp,
                              .enough = [this] { return outcome_.has_value(); }};
  const ManualResult result = drive_by_hand(
      rig_, *bench_->driver, command, bench_->temperatures,
      [&](const ManualMoment& moment) { look(moment, question); }, stop_);
  zero_confirmed_ = result.zero_confirmed;
  stop_trouble_ = result.stop_trouble;
  trouble_ = result.why;
  // What was measured counts, also if something happens while the currents go.
  if (outcome_ == Outcome::measured) log_.add(currents_, step.place, reading_of(readings_));
  if (!trouble_.empty() || !zero_confirmed_ || !stop_trouble_.empty()) return Outcome::failed;
  if (result.status == Status::stopped) return Outcome::ended;
  return outcome_.value_or(Outcome::unanswered);
}

int Guide::make(const std::vector<MeasurementStep>& steps, double tolerance) {
  const auto left = [&] { return missing_steps(steps, log_.measured().rows, tolerance); };
  std::vector<MeasurementStep> missing = left();
  if (missing.empty()) return ok;
  bench_ = std::make_unique<Bench>(rig_, o_.coils);
  note("{} measurements of {} are to be made. {}: coils to zero at once\n", missing.size(),
       steps.size(), probe_ ? "Space, e or Esc" : "Esc");
  if (!probe_) note("b: back, r: again, q: end; what was measured is kept\n");
  bool goes_on = true;
  while (goes_on && !missing.empty()) {
    const MeasurementStep& step = missing.front();
    const Moved moved = move_to(step.place);
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
      case Outcome::failed:
        if (!trouble_.empty()) note("\nmicroswarm: {}\n", trouble_);
        note_zero(zero_confirmed_, stop_trouble_);
        [[fallthrough]];
      case Outcome::ended:
        goes_on = false;
        break;
    }
    if (stop_()) goes_on = false;
    const bool failed = outcome == Outcome::failed;
    missing = left();
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
  cmd.add_option("--current", o.current,
                 "Largest current in A (default: 80 % of what each coil can hold)")
      .type_name("A")
      .check(number(1e-6, 1e6))
      .needs(measure);
  cmd.add_option("--levels", o.levels, "Currents of each sign for each coil")
      .type_name("NUMBER")
      .check(whole(1, 20))
      .needs(measure);
  cmd.add_flag("--pairs", o.pairs, "Also each coil together with the next one").needs(measure);
  cmd.add_option("--hold", o.hold, "Longest time a current waits for an answer")
      .type_name("S")
      .check(number(0.1, 3600))
      .needs(measure);
  cmd.add_option("--ramp", o.ramp, "Time of each ramp")
      .type_name("S")
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
      .type_name("S")
      .check(number(0.01, 600))
      .needs(probe);
  add_coil_options(cmd, o.coils);
  cmd.add_option("--set", o.settings, "Override a value of the rig (repeatable)")
      .type_name("KEY=VALUE")
      .needs(measure);
}

int measure(const Rig& rig, const MeasureOptions& o, const FitOptions& fit, const std::string& file,
            const Context& context) {
  if (!o.probe.empty() && o.dwell > o.hold) throw InputError("--dwell: is longer than --hold");
  const std::vector<MeasurementStep> steps =
      measurement_plan(rig.system, {.places = positions_of(o.positions, rig.system),
                                    .current = o.current,
                                    .levels = o.levels,
                                    .pairs = o.pairs});
  require_determined(steps, rig.system, fit);
  MeasurementLog log(file, rig.system.coil_names());
  Guide guide(rig, o, log, context);
  return guide.make(steps, resolution * full_scale_of(rig.params));
}

}  // namespace microswarm::cli
