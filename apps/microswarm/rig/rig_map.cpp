// SPDX-License-Identifier: Apache-2.0
#include <fmt/ranges.h>

#include <array>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "microswarm/actuation/amplifiers/amplifiers.hpp"
#include "microswarm/actuation/coils/currents.hpp"
#include "microswarm/actuation/coils/uniformity.hpp"
#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/text/file.hpp"
#include "microswarm/core/text/text.hpp"
#include "microswarm/report/uniformity_picture.hpp"
#include "rig/rig.hpp"
#include "support/options.hpp"

namespace microswarm::cli {
namespace {

using Json = nlohmann::ordered_json;

struct RigMapOptions {
  std::string system;
  std::string out;
  std::string at;
  std::string currents;
  std::string field = "1,0,0";
  std::string plane = "xy";
  std::optional<double> half_width;
  std::uint64_t points = 101;
  bool json = false;
};

int map_field(const RigMapOptions& o, const Stop& stop) {
  keep_input(o.out, o.system);
  const actuation::CoilSystem system = actuation::read_coil_system(o.system);
  actuation::UniformityGrid grid{.centre = o.at.empty() ? system.centre() : parse_triple(o.at),
                                 .plane = *enum_value<actuation::Plane>(o.plane),
                                 .points = static_cast<int>(o.points)};
  grid.half_width = o.half_width ? *o.half_width : actuation::fitting_half_width(system, grid);
  const Eigen::VectorXd currents =
      o.currents.empty()
          ? actuation::currents_for(system.at(grid.centre), parse_triple(o.field)).currents
          : parse_currents(o.currents, system);
  const std::optional<actuation::UniformityMap> made = [&] {
    ProgressBar bar("map");
    return actuation::uniformity(system, currents, grid, [&](double share) {
      bar.update(share);
      return !stop();
    });
  }();
  if (!made) return not_reached;
  actuation::UniformityMap map = *made;
  Eigen::Vector3d& b = map.centre_field;
  const double strength = b.norm();
  for (double& component : b) component = tidy(component, strength);
  const double largest = tidy(map.largest(), 1);
  const bool inside = actuation::in_workspace(system, grid);
  if (const double share = actuation::Amplifiers(system.amplifiers()).steady(currents).scale;
      share < 1)
    note("note: the coils' limits allow {:.3g} % of these currents\n", 100 * share);
  if (!o.out.empty()) {
    const std::filesystem::path out = o.out;
    if (out.extension() == ".csv")
      write_file_atomically(out, report::uniformity_table(map));
    else
      report::draw_uniformity(map, !o.at.empty(), out);
  }
  const std::array<double, 3> shares{0.01, 0.05, 0.1};
  if (o.json) {
    Json radii = Json::object();
    for (const double share : shares) radii[number_text(share)] = map.radius_within(share);
    print("{}\n", Json{{"system", system.name()},
                       {"centre_um", {grid.centre[0], grid.centre[1], grid.centre[2]}},
                       {"plane", o.plane},
                       {"half_width_um", grid.half_width},
                       {"points", grid.points},
                       {"in_workspace", inside},
                       {"centre_field_mt", {b[0], b[1], b[2]}},
                       {"largest_deviation", largest},
                       {"radius_um_within", radii}}
                      .dump(2));
    return ok;
  }
  print("B0 ({:.6g}, {:.6g}, {:.6g}) mT; at most {:.3g} % off within ±{:g} µm{}\n", b[0], b[1],
        b[2], 100 * largest, grid.half_width,
        inside ? "" : ", of which some is outside of the calibrated workspace");
  for (const double share : shares)
    print("within {:g} %: {:.0f} µm around the centre\n", 100 * share, map.radius_within(share));
  if (!o.out.empty()) print("wrote {}\n", o.out);
  return ok;
}

}  // namespace

void add_rig_map(Command rig, Action& action) {
  auto o = std::make_shared<RigMapOptions>();
  Command cmd = rig.add_command("map", "Map the uniformity of the field as a picture or a table",
                                "rig map scenarios/rigs/helmholtz.yaml --out even.png");
  cmd.add_option("system", o->system, "Coil system (YAML)")
      .required()
      .type_name("FILE")
      .input("rigs");
  cmd.add_option("--out", o->out, "File to write: .png, .svg, .pdf or .csv")
      .type_name("FILE")
      .check(file_kind({".png", ".svg", ".pdf", ".csv"}));
  cmd.add_option("--at", o->at, "Centre of the map in µm")
      .type_name("X,Y,Z")
      .default_text("centre of the system")
      .check(triple("X,Y,Z", max_place));
  const Option currents =
      cmd.add_option("--currents", o->currents, "Current of each coil in A").type_name("A,A,...");
  cmd.add_option("--field", o->field, "Field at the centre in mT")
      .type_name("BX,BY,BZ")
      .check(triple("BX,BY,BZ", max_field))
      .excludes(currents);
  cmd.add_option("--plane", o->plane, "Plane of the map: xy, xz or yz")
      .type_name("WORD")
      .check(any_word({"xy", "xz", "yz"}));
  cmd.add_option("--half-width", o->half_width, "Half the side of the map in µm")
      .type_name("NUMBER")
      .default_text("10000, or less in a smaller workspace")
      .check(number(1, 1e8));
  cmd.add_option("--points", o->points, "Points per side, 3..1001")
      .type_name("NUMBER")
      .check(whole(3, 1001));
  add_json(cmd, o->json);
  cmd.callback([o, &action] {
    action = [o](const Context& context) { return map_field(*o, context.stop); };
  });
}

}  // namespace microswarm::cli
