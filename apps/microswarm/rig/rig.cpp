// SPDX-License-Identifier: Apache-2.0
#include <fmt/ranges.h>

#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "microswarm/actuation/amplifiers/amplifiers.hpp"
#include "microswarm/actuation/coils/coil_system.hpp"
#include "microswarm/actuation/coils/currents.hpp"
#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/text/text.hpp"
#include "rig/rig.hpp"
#include "support/options.hpp"

namespace microswarm::cli {

Check triple(const char* form, double most) {
  return {[form, most](const std::string& text) -> std::string {
    const std::vector<double> v = numbers(text);
    if (v.size() != 3) return fmt::format("must be {}, not {}", form, quote(text));
    for (const double x : v)
      if (std::abs(x) > most)
        return fmt::format("{:.6g} is too much, allowed {:.6g}..{:.6g}", x, -most, most);
    return {};
  }};
}

Eigen::Vector3d parse_triple(const std::string& text) {
  const std::vector<double> v = numbers(text);
  return {v[0], v[1], v[2]};
}

Eigen::VectorXd parse_currents(const std::string& text, const actuation::CoilSystem& system) {
  const std::vector<double> given = numbers(text);
  if (given.empty()) throw InputError("--currents: must be A,A,…, not " + quote(text));
  if (given.size() != system.size())
    throw InputError(fmt::format("--currents has {} numbers, the system has {} coils: {}",
                                 given.size(), system.size(),
                                 fmt::join(system.coil_names(), ", ")));
  return Eigen::Map<const Eigen::VectorXd>(given.data(), static_cast<Eigen::Index>(given.size()));
}

std::string triple_text(const Eigen::Vector3d& v) {
  return fmt::format("({:.6g}, {:.6g}, {:.6g})", v[0], v[1], v[2]);
}

namespace {

using Json = nlohmann::ordered_json;

struct FieldOptions {
  std::string system;
  std::string at;
  std::string currents;
  std::string field;
  bool json = false;
};

Json to_json(const Eigen::VectorXd& v) {
  Json list = Json::array();
  for (const double x : v) list.push_back(x);
  return list;
}

std::string to_text(const actuation::LimitHit& hit, const actuation::CoilSystem& system) {
  const std::string_view unit = unit_symbol(actuation::limit_unit(hit.limit));
  if (!std::isfinite(hit.asked))
    return fmt::format("{} of coil {}: rises without end, allowed {:.6g} {}", enum_name(hit.limit),
                       system.coil_names()[hit.coil], hit.allowed, unit);
  return fmt::format("{} of coil {}: {:.6g} {}, allowed {:.6g} {}: {:.6g} {} too much",
                     enum_name(hit.limit), system.coil_names()[hit.coil], hit.asked, unit,
                     hit.allowed, unit, hit.asked - hit.allowed, unit);
}

Json to_json(const actuation::LimitHit& hit, const actuation::CoilSystem& system) {
  return {{"limit", enum_name(hit.limit)},
          {"coil", system.coil_names()[hit.coil]},
          {"unit", unit_suffix(actuation::limit_unit(hit.limit))},
          {"asked", hit.asked},
          {"allowed", hit.allowed}};
}

std::string why_not(const actuation::CurrentsForField& found) {
  if (found.rank == 0) return "the coils make no field there";
  std::string directions;
  for (const Eigen::Vector3d direction : found.missing.colwise())
    directions += (directions.empty() ? "" : " and ") + triple_text(direction);
  return fmt::format("the coils make no field along {}: {:.6g} mT are missing", directions,
                     found.short_by);
}

int field(const FieldOptions& o) {
  if (o.currents.empty() == o.field.empty())
    throw InputError("rig field: give either --currents or --field");
  const actuation::CoilSystem system = actuation::read_coil_system(o.system);
  const Eigen::Vector3d position = o.at.empty() ? system.centre() : parse_triple(o.at);
  const actuation::Actuation at = system.at(position);
  std::optional<actuation::CurrentsForField> found;
  if (!o.field.empty()) found = actuation::currents_for(at, parse_triple(o.field));
  const Eigen::VectorXd wanted = found ? found->currents : parse_currents(o.currents, system);
  const actuation::LimitedCurrents held = actuation::Amplifiers(system.amplifiers()).steady(wanted);
  const Eigen::Vector3d made = at.total_field(held.currents);
  const actuation::FiveGradients slope =
      actuation::five_gradients(at.total_gradient(held.currents)) / actuation::mt_per_um_of_t_per_m;
  const bool unmade = found && !found->reached;
  if (o.json) {
    Json hits = Json::array();
    for (const actuation::LimitHit& hit : held.hits) hits.push_back(to_json(hit, system));
    Json json{{"system", system.name()},
              {"at_um", to_json(position)},
              {"in_workspace", system.in_workspace(position)},
              {"coils", system.coil_names()},
              {"currents_a", to_json(held.currents)},
              {"field_mt", to_json(made)},
              {"field_abs_mt", made.norm()},
              {"gradients_t_per_m", to_json(slope)},
              {"scale", held.scale},
              {"limits", hits}};
    if (found) {
      json["rank"] = found->rank;
      json["reached"] = found->reached;
      json["short_by_mt"] = found->short_by;
    }
    print("{}\n", json.dump(2));
  } else {
    print("{} at {} µm{}\n", system.name().empty() ? o.system : system.name(),
          triple_text(position),
          system.in_workspace(position) ? "" : ", outside of the calibrated workspace");
    const Eigen::Vector3d clean = made.unaryExpr([&](double b) { return tidy(b, made.norm()); });
    print("field {} mT, {:.6g} mT in all\n", triple_text(clean), made.norm());
    // [T/m]; entries negligible relative to the field over one metre are rounded to 0.
    const auto of_slope = [&](Eigen::Index i) { return tidy(slope[i], made.norm() / 1e3); };
    print(
        "gradients dBx/dx {:.6g}, dBx/dy {:.6g}, dBx/dz {:.6g}, dBy/dy {:.6g}, dBy/dz {:.6g} "
        "T/m\n",
        of_slope(0), of_slope(1), of_slope(2), of_slope(3), of_slope(4));
    for (std::size_t i = 0; i < system.size(); ++i)
      print("  {:<10} {:12.6g} A\n", system.coil_names()[i],
            held.currents[static_cast<Eigen::Index>(i)]);
    if (unmade) print("{}\n", why_not(*found));
    for (const actuation::LimitHit& hit : held.hits) print("{}\n", to_text(hit, system));
    if (!held.hits.empty()) print("scaled to {:.1f} % of what was asked for\n", 100 * held.scale);
  }
  return unmade || !held.hits.empty() ? not_reached : ok;
}

void add_field(Command rig, Action& action) {
  auto o = std::make_shared<FieldOptions>();
  Command cmd = rig.add_command(
      "field", "Compute the field of coil currents at a position, or the currents for a field",
      "rig field scenarios/rigs/cube.yaml --at 0,0,0 --field 3,0,0");
  cmd.add_option("system", o->system, "Coil system (YAML)")
      .required()
      .type_name("FILE")
      .input("rigs");
  cmd.add_option("--at", o->at, "Position in µm")
      .type_name("X,Y,Z")
      .default_text("centre of the system")
      .check(triple("X,Y,Z", max_place));
  const Option currents =
      cmd.add_option("--currents", o->currents, "Current of each coil in A").type_name("A,A,...");
  cmd.add_option("--field", o->field, "Wanted field in mT")
      .type_name("BX,BY,BZ")
      .check(triple("BX,BY,BZ", max_field))
      .excludes(currents);
  add_json(cmd, o->json);
  cmd.callback([o, &action] { action = [o](const Context&) { return field(*o); }; });
}

}  // namespace

void add_rig(Command app, Action& action) {
  Command rig =
      app.add_group("rig", "Coils and camera: fields, calibration, checks, real-time runs");
  add_field(rig, action);
  add_rig_map(rig, action);
  add_rig_cameras(rig, action);
  add_rig_scale(rig, action);
  add_rig_see(rig, action);
  add_rig_still(rig, action);
  add_rig_flash(rig, action);
  add_rig_check(rig, action);
  add_rig_drive(rig, action);
  add_rig_simulate(rig, action);
  add_rig_run(rig, action);
  add_rig_queue(rig, action);
  add_rig_calibrate(rig, action);
  add_rig_heat(rig, action);
  add_rig_identify(rig, action);
}

}  // namespace microswarm::cli
