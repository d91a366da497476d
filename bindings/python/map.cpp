// SPDX-License-Identifier: Apache-2.0
// Maps, and paths in them.
#include "calls.hpp"
#include "drawing.hpp"
#include "microswarm/config/type.hpp"
#include "microswarm/config/write.hpp"
#include "microswarm/config/yaml.hpp"
#include "microswarm/core/errors/error.hpp"
#include "microswarm/experiment/queries/path_query.hpp"
#include "microswarm/formats/choose_map_spec.hpp"
#include "microswarm/formats/map_file.hpp"
#include "microswarm/formats/pixel_map.hpp"
#include "microswarm/formats/write_map.hpp"
#include "named_map.hpp"

namespace microswarm::python {
namespace {

NamedMap load(const std::string& file, std::optional<double> um_per_px,
              std::optional<double> um_per_unit, const Given& settings) {
  Notes notes;
  NamedMap loaded = interruptible([&](const Stop&) {
    const formats::MapSpec spec = formats::choose_map_spec(
        file,
        {.um_per_px = um_per_px, .um_per_unit = um_per_unit, .settings = to_settings(settings)});
    const formats::LoadedMap read = formats::load_map(spec);
    notes = read.notes;
    return NamedMap{Snapshot(read.map), file, spec};
  });
  warn(notes);
  return loaded;
}

NamedMap from_walls(const std::array<double, 4>& bounds, const std::vector<Numbers>& walls,
                    const Numbers& discs) {
  formats::PolygonsMap spec{
      .lo = {bounds[0], bounds[1]}, .hi = {bounds[2], bounds[3]}, .walls = {}, .discs = {}};
  for (const Numbers& wall : walls) spec.walls.push_back(places(wall, "an outline of walls_um"));
  if (discs.size() > 0 && (discs.ndim() != 2 || discs.shape(1) != 3))
    throw InputError("discs_um must have the shape (n, 3): x_um, y_um, radius_um");
  const double* row = discs.data();
  for (py::ssize_t i = 0; i < discs.size() / 3; ++i, row += 3)
    spec.discs.push_back({{row[0], row[1]}, row[2]});
  Notes notes;
  NamedMap loaded = interruptible([&](const Stop&) {
    const formats::LoadedMap read = formats::load_map({std::move(spec)});
    notes = read.notes;
    return NamedMap{Snapshot(read.map), "map"};
  });
  warn(notes);
  return loaded;
}

NamedMap from_pixels(const py::array_t<std::uint8_t, py::array::c_style>& pixels, double um_per_px,
                     double simplify) {
  if (pixels.ndim() != 2) throw InputError("an image of 2 dimensions is needed");
  const auto height = static_cast<std::size_t>(pixels.shape(0));
  const auto width = static_cast<std::size_t>(pixels.shape(1));
  const std::span<const std::uint8_t> all{pixels.data(), width * height};
  Notes notes;
  NamedMap made = interruptible([&](const Stop&) {
    formats::PixelMap read =
        formats::map_of_pixels(all, width, height, um_per_px, {.simplify = simplify});
    notes = std::move(read.notes);
    return map_in_memory(std::move(read.map));
  });
  warn(notes);
  return made;
}

py::list outlines(const NamedMap& map) {
  py::list all;
  for (const Polygon& wall : formats::to_parts(map.map()).walls) {
    py::list rings;
    rings.append(to_array(wall.outer));
    for (const auto& hole : wall.holes) rings.append(to_array(hole));
    all.append(rings);
  }
  return all;
}

py::array_t<double> discs(const NamedMap& map) {
  std::vector<double> numbers;
  for (const Disc& disc : formats::to_parts(map.map()).discs)
    numbers.insert(numbers.end(), {disc.centre.x, disc.centre.y, disc.radius});
  py::array_t<double> array({static_cast<py::ssize_t>(numbers.size() / 3), py::ssize_t{3}});
  std::ranges::copy(numbers, array.mutable_data());
  return array;
}

/// Calls `work(first, count)` for blocks of `all` positions, without the GIL; interruptible if
/// there are many.
template <class Work>
void in_blocks(std::size_t all, Work&& work) {
  constexpr std::size_t block = 4096;
  constexpr std::size_t many = 16 * block;
  const auto each = [&](const Stop& stop) {
    for (std::size_t first = 0; first < all && !stop(); first += block)
      work(first, std::min(block, all - first));
    return true;
  };
  if (all > many) {
    interruptible(each);
    return;
  }
  const Free free;
  each({});
}

py::array_t<double> clearance(const NamedMap& map, const Numbers& array) {
  const std::vector<Vec2> asked = places(array, "places_um");
  py::array_t<double> found(static_cast<py::ssize_t>(asked.size()));
  double* out = found.mutable_data();
  in_blocks(asked.size(), [&](std::size_t first, std::size_t count) {
    for (std::size_t i = first; i < first + count; ++i)
      out[i] = is_finite(asked[i]) ? map.world.clearance(asked[i]) : 0;
  });
  return found;
}

py::array_t<bool> are_free(const NamedMap& map, const Numbers& array, double clearance) {
  const std::vector<Vec2> asked = places(array, "places_um");
  py::array_t<bool> found(static_cast<py::ssize_t>(asked.size()));
  static_assert(sizeof(bool) == 1);
  const std::span<std::uint8_t> out{reinterpret_cast<std::uint8_t*>(found.mutable_data()),
                                    asked.size()};
  in_blocks(asked.size(), [&](std::size_t first, std::size_t count) {
    map.world.are_free(std::span(asked).subspan(first, count), clearance,
                       out.subspan(first, count));
  });
  return found;
}

/// The source of a map as a value with keys.
struct MapSource {
  formats::MapSpec map;
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.map, plain("map", "Source of the map."));
  }
};

/// Everything that a map is built from, for pickle.
py::tuple state_of(const NamedMap& map) {
  const Box& box = map.map().bounds();
  return py::make_tuple(map.name, to_yaml(MapSource{map.spec}),
                        std::array<double, 4>{box.lo.x, box.lo.y, box.hi.x, box.hi.y},
                        outlines(map), discs(map));
}

NamedMap restored(const py::tuple& state) {
  const auto bounds = state[2].cast<std::array<double, 4>>();
  std::vector<Polygon> walls;
  for (const py::handle rings : state[3]) {
    Polygon wall;
    for (const py::handle ring : rings) {
      std::vector<Vec2> points = places(ring.cast<Numbers>(), "a ring of a map");
      if (wall.outer.empty())
        wall.outer = std::move(points);
      else
        wall.holes.push_back(std::move(points));
    }
    walls.push_back(std::move(wall));
  }
  std::vector<Disc> discs;
  const auto rows = state[4].cast<Numbers>();
  for (py::ssize_t i = 0; i < rows.shape(0); ++i)
    discs.push_back({{rows.at(i, 0), rows.at(i, 1)}, rows.at(i, 2)});
  auto map = std::make_shared<const Map>(Box{{bounds[0], bounds[1]}, {bounds[2], bounds[3]}},
                                         std::move(walls), discs);
  return {Snapshot(std::move(map)), state[0].cast<std::string>(),
          read_yaml_text<MapSource>(state[1].cast<std::string>(), "a pickled map").map};
}

py::dict plan_path(const NamedMap& map, const std::vector<double>& start,
                   const std::vector<double>& goal, const Given& settings, std::uint64_t seed) {
  if (start.size() != 2 && start.size() != 3)
    throw InputError("start must be (x_um, y_um) or (x_um, y_um, heading_rad)");
  if (goal.size() != 2) throw InputError("goal must be (x_um, y_um)");
  const experiment::PathQuery query{
      .start = {{start[0], start[1]}, start.size() > 2 ? start[2] : 0},
      .goal = {goal[0], goal[1]},
      .settings = to_settings(settings),
      .seed = seed};
  const auto kept = std::make_shared<const experiment::PathAnswer>(interruptible(
      [&](const Stop& stop) { return experiment::answer(map.world, query, map.name, stop); }));
  const experiment::PathAnswer& made = *kept;
  warn(made.notes);
  std::vector<Vec2> nodes;
  py::array_t<std::uint32_t> parents(static_cast<py::ssize_t>(made.plan.tree.size()));
  std::uint32_t* parent = parents.mutable_data();
  nodes.reserve(made.plan.tree.size());
  for (const TreeNode& node : made.plan.tree) {
    nodes.push_back(node.position);
    *parent++ = node.parent;
  }
  py::dict out;
  out["status"] = std::string(to_string(made.plan.status));
  out["path_um"] = to_array(made.plan.path);
  out["length_um"] = path_length(made.plan);
  out["turning_rad"] = path_turning(made.plan.path, query.start.heading);
  out["time_s"] = made.seconds;
  out["why_none"] = made.why_none();
  out["planner"] = experiment::planner_json(made.planner);
  out["tree_um"] = to_array(nodes);
  out["parents"] = parents;
  out["draw"] = py::cpp_function([kept, map, from = query.start.position,
                                  to = query.goal](const std::optional<std::string>& file) {
    return drawn(file, [&] {
      return report::draw_plan(map.map(), kept->plan, from,
                               {to, experiment::path_limits(kept->planner).goal_tolerance},
                               std::string(to_string(kept->plan.status)) + ", " +
                                   std::to_string(std::lround(path_length(kept->plan))) + " µm");
    });
  });
  return out;
}

}  // namespace

void add_map(py::module_& module) {
  py::list planners;
  for (const std::string_view name : type_of<planning::PlannerParams>().words)
    planners.append(name);
  module.attr("planners") = py::tuple(planners);
  py::class_<NamedMap>(module, "Map")
      .def_static("load", load)
      .def_static("from_walls", from_walls)
      .def_static("from_pixels", from_pixels)
      .def("outlines", outlines)
      .def("discs", discs)
      .def("clearance", clearance)
      .def("are_free", are_free)
      .def("plan", plan_path)
      .def(py::pickle(&state_of, &restored))
      .def("draw",
           [](const NamedMap& map, const std::optional<std::string>& file) {
             return drawn(file, [&] {
               return report::draw_map(map.map(),
                                       std::filesystem::path(map.name).filename().string());
             });
           })
      .def("bounds", [](const NamedMap& map) {
        const Box& box = map.map().bounds();
        return std::array<double, 4>{box.lo.x, box.lo.y, box.hi.x, box.hi.y};
      });
}

}  // namespace microswarm::python
