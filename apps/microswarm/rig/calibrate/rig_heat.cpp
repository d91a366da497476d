// SPDX-License-Identifier: Apache-2.0
// `rig heat`: resistance, thermal resistance and time constant of a coil from its voltage.
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "microswarm/actuation/amplifiers/coil_heat.hpp"
#include "microswarm/actuation/coils/heat_fit.hpp"
#include "microswarm/config/write.hpp"
#include "microswarm/config/yaml.hpp"
#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/text/file.hpp"
#include "microswarm/core/text/input_folder.hpp"
#include "microswarm/core/text/text.hpp"
#include "microswarm/rig/runtime/coil_temperatures.hpp"
#include "rig/calibrate/measure_heat.hpp"
#include "rig/rig.hpp"
#include "rig/rig_settings.hpp"
#include "support/options.hpp"

namespace microswarm::cli {
namespace {

using Json = nlohmann::ordered_json;

struct HeatOptions {
  std::string log;
  std::string coils;
  std::vector<std::string> names;
  std::optional<double> ambient;
  std::string out;
  bool json = false;
  HeatMeasureOptions measure;
};

/// The coil file that a log is of.
struct HeatedSystem {
  std::string file;
  actuation::CoilSystemParams params;
  actuation::CoilSystem system;
};

HeatedSystem read_system(const std::string& file) {
  return {file, read_yaml_file<actuation::CoilSystemParams>(file),
          actuation::read_coil_system(file)};
}

/// Index of a coil by its name. Throws InputError if there is none.
std::size_t find_coil(const actuation::CoilSystem& system, const std::string& name) {
  const std::vector<std::string>& names = system.coil_names();
  const auto found = std::ranges::find(names, name);
  if (found == names.end())
    throw InputError(fmt::format("--coil: no coil is named {}, there are {}", quote(name),
                                 fmt::join(names, ", ")));
  return static_cast<std::size_t>(found - names.begin());
}

/// The system's amplifiers with the fitted values for these coils; one entry for each coil.
std::vector<actuation::AmplifierParams> with_fit(std::vector<actuation::AmplifierParams> amplifiers,
                                                 const std::vector<std::size_t>& coils,
                                                 const actuation::HeatFit& fit) {
  const auto rounded = [](double value) { return *parse_number(fmt::format("{:.4g}", value)); };
  for (const std::size_t k : coils) {
    if (fit.resistance.error > 0) amplifiers[k].resistance = rounded(fit.resistance.value);
    amplifiers[k].thermal_resistance = rounded(fit.thermal_resistance.value);
    amplifiers[k].thermal_time = rounded(fit.thermal_time.value);
  }
  return amplifiers;
}

/// Writes the coil system with these amplifiers; it is read as it would be from there first.
void write_system(HeatedSystem heated, std::vector<actuation::AmplifierParams> amplifiers,
                  const std::string& out) {
  heated.params.amplifiers = std::move(amplifiers);
  const std::string text = to_yaml(heated.params);
  const actuation::CoilSystem again(read_yaml_text<actuation::CoilSystemParams>(text, out), {},
                                    input_folder(out));
  write_file_atomically(out, text);
}

Json to_json(const actuation::FittedValue& fitted) {
  return {{"value", fitted.value}, {"error", fitted.error}};
}

void tell_json(const actuation::HeatFit& fit, const actuation::AmplifierParams& coil) {
  Json json{{"resistance_ohm", to_json(fit.resistance)},
            {"thermal_resistance_k_per_w", to_json(fit.thermal_resistance)},
            {"thermal_time_s", to_json(fit.thermal_time)},
            {"ambient_degc", coil.ambient},
            {"warmest_degc", fit.warmest},
            {"rms_k", fit.rms},
            {"worst_k", fit.worst},
            {"worst_line", fit.worst_line},
            {"holds_a", nullptr}};
  if (coil.max_temperature) json["holds_a"] = actuation::warmest_current(coil);
  print("{}\n", json.dump(2));
}

void tell(const actuation::HeatFit& fit, const actuation::AmplifierParams& coil) {
  if (fit.resistance.error > 0)
    print("resistance {:.4g} ± {:.2g} Ω at 20 °C\n", fit.resistance.value, fit.resistance.error);
  print("thermal resistance {:.4g} ± {:.2g} K/W\n", fit.thermal_resistance.value,
        fit.thermal_resistance.error);
  print("time constant {:.4g} ± {:.2g} s\n", fit.thermal_time.value, fit.thermal_time.error);
  print(
      "the coil was at most at {:.3g} °C, from {:.3g} °C on; RMS residual {:.2g} K, the worst "
      "{:.2g} K, line {}\n",
      fit.warmest, coil.ambient, fit.rms, fit.worst, fit.worst_line);
  if (coil.max_temperature)
    print("it holds {:.3g} A indefinitely, then it is at its {:.4g} °C\n",
          actuation::warmest_current(coil), *coil.max_temperature);
}

int rig_heat(const HeatOptions& o, const Context& context) {
  keep_input(o.out, o.log);
  std::optional<HeatedSystem> heated;
  if (!o.measure.rig.empty()) {
    const rig::Rig rig = reading([&] {
      return rig::read_rig(o.measure.rig, {o.measure.settings, "--set"});
    });
    heated = reading([&] { return read_system((rig.folder / rig.params.coils).string()); });
    heated->params.id = rig::coil_identity(rig);
    if (o.names.empty()) throw InputError("--measure: name the coil to heat with --coil");
    for (const std::string& name : o.names) find_coil(heated->system, name);
    HeatMeasureOptions measure = o.measure;
    measure.ambient = o.ambient;
    if (const int code =
            measure_heat(rig, find_coil(heated->system, o.names.front()), measure, o.log, context);
        code != ok)
      return code;
  } else if (!o.coils.empty()) {
    heated = reading([&] { return read_system(o.coils); });
  }
  if (!o.out.empty() && (!heated || o.names.empty()))
    throw InputError("--out: needs the coils' file, --coils or --measure, and --coil");

  std::vector<std::size_t> coils;
  for (const std::string& name : o.names)
    if (heated) coils.push_back(find_coil(heated->system, name));
  actuation::AmplifierParams known;
  if (!coils.empty()) known = heated->system.amplifiers()[coils.front()];
  if (o.ambient) known.ambient = *o.ambient;
  const actuation::HeatLog log = reading([&] { return actuation::read_heat_log(o.log); });
  if (coils.empty() && std::ranges::none_of(log.rows, [](const actuation::HeatRow& row) {
        return row.voltage.has_value();
      }))
    throw InputError(o.log,
                     "has no voltages: name the coil, whose resistance must be known, with "
                     "--coils and --coil");
  const actuation::HeatFit fit = reading([&] { return actuation::fit_heat(log, known); });
  const actuation::AmplifierParams fitted = with_fit({known}, {0}, fit).front();
  if (!o.ambient)
    note("note: the coil is taken to have begun at {:.4g} °C: give --ambient if it did not\n",
         known.ambient);
  if (o.json)
    tell_json(fit, fitted);
  else
    tell(fit, fitted);
  if (o.out.empty()) return ok;
  const std::size_t entries = heated->system.amplifiers().size();
  write_system(*heated, with_fit(heated->system.amplifiers(), coils, fit), o.out);
  if (coils.size() < entries)
    note("note: {} of {} coils have the new values: give --coil for each that is alike\n",
         coils.size(), entries);
  if (!o.json) print("wrote {}\n", o.out);
  return ok;
}

}  // namespace

void add_rig_heat(Command rig, Action& action) {
  auto o = std::make_shared<HeatOptions>();
  Command cmd =
      rig.add_command("heat", "Measure how a coil heats, and fit its resistance and thermal model",
                      "rig heat samples/coils/heat.csv --ambient 22");
  cmd.add_option("log", o->log, "CSV with t_s, i_a and v_v, or temperature_degc of a probe")
      .required()
      .type_name("FILE")
      .input();
  cmd.add_option("--coils", o->coils, "Coil system whose limits are known (YAML)")
      .type_name("FILE");
  cmd.add_option("--coil", o->names, "Coil of the log; further ones that are alike")
      .type_name("NAME");
  cmd.add_option("--ambient", o->ambient, "Temperature at the start in °C")
      .type_name("DEGC")
      .default_text("that of the coil's file, else 22")
      .check(number(-50, 100));
  cmd.add_option("--out", o->out, "Coil system to write with the values (YAML)").type_name("FILE");
  add_json(cmd, o->json);
  add_heat_measure_options(cmd, o->measure);
  cmd.callback(
      [o, &action] { action = [o](const Context& context) { return rig_heat(*o, context); }; });
}

}  // namespace microswarm::cli
