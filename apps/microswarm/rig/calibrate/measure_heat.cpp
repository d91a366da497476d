// SPDX-License-Identifier: Apache-2.0
// Guided measurement for `rig heat --measure`.
#include "rig/calibrate/measure_heat.hpp"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>

#include "microswarm/actuation/amplifiers/coil_heat.hpp"
#include "microswarm/actuation/coils/heat_fit.hpp"
#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/execution/clock.hpp"
#include "microswarm/core/text/text.hpp"
#include "microswarm/rig/runtime/manual_drive.hpp"
#include "rig/keys/answer_line.hpp"
#include "rig/rig_settings.hpp"
#include "support/options.hpp"

namespace microswarm::cli {
namespace {

constexpr double cold_margin = 2;        // [K] above ambient temperature
constexpr double heat_ramp = 0.5;        // [s]
constexpr double cooling_share = 0.1;    // of the current, which still shows the resistance
constexpr double current_change = 0.02;  // relative, from which on a row is written
constexpr double usual_share = 0.8;      // of the current that the coil holds, by its file

/// Dialogue with the operator who reads the voltmeter.
class HeatDialogue {
 public:
  HeatDialogue(const rig::Rig& rig, std::size_t coil, const HeatMeasureOptions& o,
               const std::string& file, const Context& context)
      : rig_(rig), coil_(coil), o_(o), file_(file), stop_(context.stop), answers_(false) {
    known_ = rig.system.amplifiers()[coil];
    if (o.ambient) known_.ambient = *o.ambient;
  }

  int make() {
    Bench bench(rig_, o_.coils);
    const double ambient = rig_.system.amplifiers()[coil_].ambient;
    if (const double now = bench.temperatures[column()]; now > ambient + cold_margin)
      throw InputError(fmt::format(
          "coil {} is at {:.3g} °C by its last runs: it must be cold, {:.4g} °C; wait, or give "
          "--coils-cold if nothing is known of it",
          name(), now, ambient));
    note(
        "read the voltage at the terminals of coil {}, not at the amplifier. Esc: coils to zero at "
        "once; q: end this part\n",
        name());
    rows_.open(file_);
    rows_ << actuation::heat_header << '\n';
    began_ = steady_seconds();
    const double current = o_.current.value_or(usual_current());
    if (const int code = drive(bench, current, o_.heat, "heating"); code != ok) return code;
    return drive(bench, cooling_share * current, o_.cool, "cooling");
  }

 private:
  std::string name() const { return rig_.system.coil_names()[coil_]; }
  Eigen::Index column() const { return static_cast<Eigen::Index>(coil_); }

  double usual_current() const {
    double current = known_.max_temperature ? actuation::warmest_current(known_)
                                            : std::numeric_limits<double>::infinity();
    if (known_.max_current) current = std::min(current, *known_.max_current);
    if (!std::isfinite(current))
      throw InputError(
          "--current: is needed, the coil's file limits neither current nor "
          "temperature");
    return usual_share * current;
  }

  /// Adds a row to the file. It is not synced, since the coils wait for no disk.
  void add(double current, std::optional<double> voltage = {}) {
    rows_ << actuation::to_csv_row(
        {.t = steady_seconds() - began_, .current = current, .voltage = voltage});
    if (!rows_.flush()) throw InputError(file_, "cannot write");
    logged_ = current;
  }

  void ask(double current) {
    asked_ = steady_seconds();
    waits_ = true;
    answers_.ask(
        fmt::format("{:.0f} s, {:.4g} A: volts of coil {}: ", asked_ - began_, current, name()));
  }

  /// Takes the answer, if there is one. The coil's temperature by its resistance ends the heating.
  void take_answer(double current) {
    const auto line = answers_.poll();
    if (!line) {
      if (answers_.ended()) ended_ = true;
      return;
    }
    const std::string text(trimmed(*line));
    if (text == "q") {
      ended_ = true;
      return;
    }
    const std::optional<double> volts = parse_number(text);
    if (!volts || !(*volts * current > 0)) {
      note("a voltage with the sign of the current is needed, not {}\n", quote(text));
      return ask(current);
    }
    waits_ = false;
    add(current, volts);
    const double resistance = *volts / current;
    if (!cold_) cold_ = resistance;
    const double temperature = actuation::temperature_by(resistance, *cold_, known_);
    note("{:.4g} Ω, {:.3g} °C\n", resistance, temperature);
    if (known_.max_temperature && temperature >= *known_.max_temperature && heats_) {
      note("note: that is the coil's maximum temperature, {:.4g} °C: the heating ends\n",
           *known_.max_temperature);
      ended_ = true;
    }
  }

  /// `seconds` of this part, with its two ramps; during them nothing is asked or taken.
  void take(const rig::ManualMoment& moment, double current, double seconds) {
    const double now = moment.output.acknowledged[column()];
    if (!logged_ || std::abs(now - *logged_) > current_change * std::abs(current)) add(now);
    const bool is_ramp = moment.t <= heat_ramp || moment.t >= seconds - heat_ramp || ended_;
    if (is_ramp) return answers_.watch();
    if (!waits_ && steady_seconds() - asked_ >= o_.every) ask(now);
    take_answer(now);
    if (waits_ && steady_seconds() - asked_ > o_.hold)
      throw HardwareError(fmt::format("no answer in {:.6g} s", o_.hold));
  }

  int drive(Bench& bench, double current, double seconds, const char* what) {
    note("{}: {:.4g} A for {:.4g} s\n", what, current, seconds);
    ended_ = waits_ = false;
    asked_ = -o_.every;
    heats_ = !logged_;
    Eigen::VectorXd currents = Eigen::VectorXd::Zero(bench.temperatures.size());
    currents[column()] = current;
    const rig::ManualResult result = rig::drive_by_hand(
        rig_, *bench.driver,
        {.wanted = currents,
         .seconds = seconds,
         .ramp = heat_ramp,
         .enough = [&] { return ended_; }},
        bench.temperatures,
        [&](const rig::ManualMoment& moment) {
          bench.temperatures = moment.output.temperatures;
          if (bench.kept) bench.kept->take(bench.temperatures);
          take(moment, current, seconds);
        },
        stop_);
    if (bench.kept) bench.kept->take(result.zero);
    if (logged_) add(0);
    if (!result.why.empty()) note("\nmicroswarm: {}\n", result.why);
    if (!note_zero(result.zero) || result.status == Status::fault) return hardware;
    return result.status == Status::stopped ? not_reached : ok;
  }

  const rig::Rig& rig_;
  std::size_t coil_;
  const HeatMeasureOptions& o_;
  std::string file_;
  std::ofstream rows_;
  std::optional<double> logged_;  // current of the last row [A]
  Stop stop_;
  AnswerLine answers_;
  actuation::AmplifierParams known_;
  double began_ = 0;
  double asked_ = 0;
  bool waits_ = false;  // for an answer
  bool ended_ = false;  // this part
  bool heats_ = false;
  std::optional<double> cold_;  // resistance at the first answer [Ω]
};

}  // namespace

void add_heat_measure_options(Command cmd, HeatMeasureOptions& o) {
  const Option measure =
      cmd.add_option("--measure", o.rig, "Heat the coil on this rig and ask for its voltage")
          .type_name("RIG");
  cmd.add_option("--current", o.current, "Current in A")
      .type_name("A")
      .default_text("80 % of what the coil holds by its file")
      .check(number(1e-6, 1e6))
      .needs(measure);
  const auto add_time = [&](const char* name, double& value, const char* text) {
    cmd.add_option(name, value, text).type_name("SECONDS").check(number(0.1, 1e5)).needs(measure);
  };
  add_time("--heat", o.heat, "Time with the current");
  add_time("--cool", o.cool, "Time with a tenth of it, afterwards");
  add_time("--every", o.every, "Time between two questions");
  add_time("--hold", o.hold, "Longest time a current waits for an answer");
  add_coil_options(cmd, o.coils);
  add_rig_settings(cmd, "--set", o.settings).needs(measure);
}

int measure_heat(const rig::Rig& rig, std::size_t coil, const HeatMeasureOptions& o,
                 const std::string& file, const Context& context) {
  if (std::filesystem::exists(file))
    throw InputError(file, "exists: a coil is measured from cold in one go, name another file");
  return HeatDialogue(rig, coil, o, file, context).make();
}

}  // namespace microswarm::cli
