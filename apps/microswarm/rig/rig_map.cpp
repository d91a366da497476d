// SPDX-License-Identifier: Apache-2.0
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "microswarm/actuation/coils/currents.hpp"
#include "microswarm/actuation/coils/uniformity.hpp"
#include "microswarm/actuation/drivers/coil_drive.hpp"
#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/text/file.hpp"
#include "microswarm/core/text/text.hpp"
#include "microswarm/io/columns.hpp"
#include "microswarm/report/picture.hpp"
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

/// Bands of increasing deviation.
struct Band {
  double most;
  const char* label;
  Colour colour;
};
constexpr std::array<Band, 6> bands{{{0.001, "to 0.1 %", {0.99, 0.96, 0.80, 1}},
                                     {0.01, "to 1 %", {0.78, 0.89, 0.70, 1}},
                                     {0.02, "to 2 %", {0.47, 0.78, 0.72, 1}},
                                     {0.05, "to 5 %", {0.25, 0.60, 0.72, 1}},
                                     {0.10, "to 10 %", {0.20, 0.40, 0.65, 1}},
                                     {1e300, "more", {0.17, 0.20, 0.42, 1}}}};

const Band& band_of(double deviation) {
  return *std::find_if(bands.begin(), bands.end() - 1,
                       [&](const Band& band) { return deviation <= band.most; });
}

/// One pixel per point, the highest row on top.
Image image_of(const UniformityMap& map) {
  const int n = map.grid.points;
  Image image{n, n, 3, std::vector<std::uint8_t>(static_cast<std::size_t>(n) * n * 3)};
  for (int row = 0; row < n; ++row)
    for (int column = 0; column < n; ++column) {
      const Colour c = band_of(map.at(column, row)).colour;
      std::uint8_t* pixel = &image.pixels[image.index(column, n - 1 - row)];
      for (const double part : {c.red, c.green, c.blue})
        *pixel++ = static_cast<std::uint8_t>(std::lround(255 * part));
    }
  return image;
}

void draw(const UniformityMap& map, const std::string& title, const std::filesystem::path& out) {
  // Each point is the centre of its pixel.
  const double step = 2 * map.grid.half_width / (map.grid.points - 1);
  const double side = step * map.grid.points;
  Picture picture(Box{{0, 0}, {side, side}}, title, 800);
  picture.photo(image_of(map), step);
  picture.mark({0.5 * side, 0.5 * side}, "B0");
  for (const Band& band : bands) picture.legend(band.label, band.colour);
  picture.write(out);
}

/// A point of the grid as in the table.
struct FieldRow {
  std::array<double, 3> place{};
  std::array<double, 3> field{};
  double deviation = 0;
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.place[0], {"x", Unit::um, {}, "Place among the coils."});
    visit(self.place[1], {"y", Unit::um, {}, "Place among the coils."});
    visit(self.place[2], {"z", Unit::um, {}, "Place among the coils."});
    visit(self.field[0], {"bx", Unit::mt, {}, "Field."});
    visit(self.field[1], {"by", Unit::mt, {}, "Field."});
    visit(self.field[2], {"bz", Unit::mt, {}, "Field."});
    visit(self.deviation, {"deviation", Unit::none, {}, "From the field at the centre."});
  }
};

std::string csv_of(const UniformityMap& map) {
  std::vector<FieldRow> rows;
  for (int row = 0; row < map.grid.points; ++row)
    for (int column = 0; column < map.grid.points; ++column) {
      const auto i = static_cast<std::size_t>(row) * map.grid.points + column;
      const Eigen::Vector3d p = map.place(column, row);
      const Eigen::Vector3d& b = map.field[i];
      rows.push_back({{p[0], p[1], p[2]}, {b[0], b[1], b[2]}, map.deviation[i]});
    }
  return csv_table(rows);
}

/// Whether the whole grid is inside the calibrated workspace.
bool in_workspace(const CoilSystem& system, const UniformityGrid& grid) {
  const UniformityMap map{.grid = grid, .centre_field = {}, .field = {}, .deviation = {}};
  const int last = grid.points - 1;
  return system.in_workspace(map.place(0, 0)) && system.in_workspace(map.place(last, 0)) &&
         system.in_workspace(map.place(0, last)) && system.in_workspace(map.place(last, last));
}

/// One centimetre, or less if the system's workspace is smaller.
double usual_half_width(const CoilSystem& system, UniformityGrid grid) {
  const double usual = grid.half_width;
  for (; grid.half_width > 1; grid.half_width *= 0.9)
    if (in_workspace(system, grid)) return grid.half_width;
  return usual;
}

/// Title: axes, the centre unless it is that of the system, and the field there.
std::string title_of(const UniformityMap& map, bool is_middle) {
  const std::string_view plane = enum_name(map.grid.plane);
  const Eigen::Vector3d& c = map.grid.centre;
  const Eigen::Vector3d& b = map.centre_field;
  return fmt::format(
      "|B − B0| / |B0|, {} to the right, {} up{}, B0 = ({:.3g}, {:.3g}, {:.3g}) mT", plane[0],
      plane[1], is_middle ? "" : fmt::format(", around ({:g}, {:g}, {:g}) µm", c[0], c[1], c[2]),
      b[0], b[1], b[2]);
}

int map_field(const RigMapOptions& o, const Stop& stop) {
  keep_input(o.out, o.system);
  const CoilSystem system = read_coil_system(o.system);
  UniformityGrid grid{.centre = o.at.empty() ? system.centre() : triple_of(o.at),
                      .plane = *enum_value<Plane>(o.plane),
                      .points = static_cast<int>(o.points)};
  grid.half_width = o.half_width ? *o.half_width : usual_half_width(system, grid);
  const Eigen::VectorXd currents =
      o.currents.empty() ? currents_for(system.at(grid.centre), triple_of(o.field)).currents
                         : currents_of(o.currents, system);
  const std::optional<UniformityMap> made = [&] {
    ProgressBar bar("map");
    return uniformity(system, currents, grid, [&](double share) {
      bar.update(share);
      return !stop();
    });
  }();
  if (!made) return not_reached;
  UniformityMap map = *made;
  Eigen::Vector3d& b = map.centre_field;
  const double strength = b.norm();
  for (double& component : b) component = tidy(component, strength);
  const double largest = tidy(map.largest(), 1);
  const bool inside = in_workspace(system, grid);
  if (const double share = CoilDrive(system.drives()).steady(currents).scale; share < 1)
    note("note: the coils' limits allow {:.3g} % of these currents\n", 100 * share);
  if (!o.out.empty()) {
    const std::filesystem::path out = o.out;
    if (out.extension() == ".csv")
      write_file_atomically(out, csv_of(map));
    else
      draw(map, title_of(map, o.at.empty()), out);
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
  cmd.add_option("system", o->system, "Coil system (YAML)").required().type_name("FILE");
  cmd.add_option("--out", o->out, "File to write: .png, .svg, .pdf or .csv")
      .type_name("FILE")
      .check(file_kind({".png", ".svg", ".pdf", ".csv"}));
  cmd.add_option("--at", o->at, "Centre of the map in µm (default: centre of the system)")
      .type_name("X,Y,Z")
      .check(triple("X,Y,Z", max_place));
  const Option currents =
      cmd.add_option("--currents", o->currents, "Current of each coil in A").type_name("A,A,…");
  cmd.add_option("--field", o->field, "Field at the centre in mT (default: 1,0,0)")
      .type_name("BX,BY,BZ")
      .check(triple("BX,BY,BZ", max_field))
      .excludes(currents);
  cmd.add_option("--plane", o->plane, "Plane of the map: xy, xz or yz")
      .type_name("WORD")
      .check(one_of({"xy", "xz", "yz"}));
  cmd.add_option("--half-width", o->half_width,
                 "Half the side of the map in µm (default: 10000, or less in a smaller workspace)")
      .type_name("NUMBER")
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
