// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "cli.hpp"
#include "microswarm/config/yaml.hpp"
#include "microswarm/core/error.hpp"
#include "microswarm/formats/map_file.hpp"
#include "microswarm/formats/write_map.hpp"
#include "microswarm/vision/agreement.hpp"
#include "microswarm/vision/outline.hpp"
#include "microswarm/vision/overlay.hpp"
#include "microswarm/vision/vessels.hpp"
#include "microswarm/world/passage.hpp"

namespace microswarm::cli {
namespace {

using Json = nlohmann::ordered_json;

struct Options {
  std::string map;
  std::optional<double> um_per_px;
  bool json = false;
};

void add_input(CLI::App* cmd, const std::shared_ptr<Options>& o) {
  cmd->add_option("map", o->map, "Picture, ROS YAML, MovingAI .map, GeoJSON or CSV of rectangles")
      ->required();
  cmd->add_option("--um-per-px", o->um_per_px, "µm per pixel or cell")
      ->check(CLI::Range(1e-6, 1e6));
}

LoadedMap load(const Options& o) { return load_map(guess_map_spec(o.map, o.um_per_px)); }

int info(const Options& o) {
  const LoadedMap loaded = load(o);
  const Box& b = loaded.map->bounds();
  const auto bodies = loaded.map->walls().bodies();
  std::size_t vertices = 0;
  std::size_t discs = 0;
  for (const Body& body : bodies) {
    if (const auto* polygon = std::get_if<Polygon>(&body.shape)) {
      vertices += polygon->outer.size();
      for (const auto& hole : polygon->holes) vertices += hole.size();
    } else {
      ++discs;
    }
  }
  if (o.json)
    fmt::print("{}\n", Json{{"lo_um", {b.lo.x, b.lo.y}},
                            {"hi_um", {b.hi.x, b.hi.y}},
                            {"walls", bodies.size()},
                            {"discs", discs},
                            {"vertices", vertices},
                            {"hash", fmt::format("{:016x}", loaded.input_hash)}}
                           .dump(2));
  else
    fmt::print("{}: {:g}..{:g} × {:g}..{:g} µm, {} walls ({} discs), {} vertices, hash {:016x}\n",
               o.map, b.lo.x, b.hi.x, b.lo.y, b.hi.y, bodies.size(), discs, vertices,
               loaded.input_hash);
  return ok;
}

int check(const Options& o, double resolution) {
  const MapReport r = check_map(*load(o).map, resolution);
  if (o.json) {
    fmt::print("{}\n", Json{{"wall_pieces", r.wall_pieces},
                            {"free_area_um2", r.free_area},
                            {"free_pieces", r.free_pieces},
                            {"region_areas_um2", r.region_areas},
                            {"widest_um", r.widest},
                            {"narrowest_passage_um", r.narrowest_passage},
                            {"resolution_um", r.resolution}}
                           .dump(2));
  } else {
    const double largest = r.region_areas.empty() ? 0 : r.region_areas[0];
    fmt::print("{} wall pieces; free: {:.0f} µm² in {} pieces, the largest has {:.1f} %\n",
               r.wall_pieces, r.free_area, r.free_pieces,
               r.free_area > 0 ? 100 * largest / r.free_area : 0.0);
    fmt::print(
        "narrowest passage of the largest piece {:.1f} µm (±{:.1f} µm); widest disc {:.1f} µm\n",
        r.narrowest_passage, 1.5 * r.resolution, r.widest);
    fmt::print(
        "fits: a swarm of up to {:.1f} µm radius passes everywhere, one of up to {:.1f} µm fits "
        "somewhere\n",
        0.5 * r.narrowest_passage, 0.5 * r.widest);
  }
  if (r.free_pieces == 0) throw InputError(o.map + ": all of the map is blocked");
  return ok;
}

int convert(const Options& o, const std::string& out, double cell) {
  write_map(out, *load(o).map, cell);
  fmt::print("wrote {}\n", out);
  return ok;
}

struct SegmentOptions {
  std::string photo;
  std::string out = "vessels.geojson";
  std::string truth;
  std::vector<std::string> settings;
  double um_per_px = 0;
  double smooth = 1.0;
  bool json = false;
};

std::string share(const std::optional<double>& v) { return v ? fmt::format("{:.3f}", *v) : "–"; }
Json json_share(const std::optional<double>& v) { return v ? Json(*v) : Json(nullptr); }

int segment(const SegmentOptions& o) {
  if (o.um_per_px <= 0) throw InputError(o.photo + ": µm per px is missing: give --um-per-px");
  VesselParams params;
  for (const std::string& s : o.settings) set_value(params, s);
  const Image photo = read_image(o.photo);
  const VesselSegmentation found = segment_vessels(photo, params);
  if (found.kept_share == 0) throw InputError(o.photo + ": no vessels found");
  const Map map(cell_bounds(found.vessels, o.um_per_px),
                outline(complement(found.vessels), o.um_per_px, o.smooth * o.um_per_px));
  const std::filesystem::path out = o.out;
  std::filesystem::path picture = out;
  picture.replace_filename(out.stem().string() + "-overlay.png");
  if (!out.parent_path().empty()) make_folder(out.parent_path().string());
  write_map(out, map, o.um_per_px);
  write_png(picture, overlay(photo, found.vessels));

  Json json{{"vessel_share", found.view_share},
            {"pieces", found.pieces},
            {"kept_share", found.kept_share},
            {"bridges", found.bridges},
            {"wide_width_um", found.wide_width_px * o.um_per_px}};
  std::string text = fmt::format(
      "vessels cover {:.1f} % of the view, wide ones {:.0f} µm; {} gaps bridged; kept {:.0f} % of "
      "{} "
      "pieces\n",
      100 * found.view_share, found.wide_width_px * o.um_per_px, found.bridges,
      100 * found.kept_share, found.pieces);
  if (!o.truth.empty()) {
    const Mask truth = threshold(read_image(o.truth), 128, false);
    const Agreement a = compare(truth, found.vessels, &found.field_of_view);
    json["sensitivity"] = json_share(a.sensitivity());
    json["specificity"] = json_share(a.specificity());
    json["dice"] = json_share(a.dice());
    text +=
        fmt::format("against {}: sensitivity {}, specificity {}, Dice {} in the field of view\n",
                    o.truth, share(a.sensitivity()), share(a.specificity()), share(a.dice()));
  }
  if (o.json)
    fmt::print("{}\n", json.dump(2));
  else
    fmt::print("{}wrote {} and {}\n", text, out.string(), picture.string());
  return ok;
}

void add_segment(CLI::App* map, Action& action) {
  auto o = std::make_shared<SegmentOptions>();
  CLI::App* cmd =
      map->add_subcommand("segment", "Find dark vessels in a photograph: map and overlay");
  cmd->add_option("photo", o->photo, "Photograph")->required();
  cmd->add_option("--um-per-px", o->um_per_px, "µm per pixel");
  cmd->add_option("--out", o->out, "Map to write; the overlay picture stands beside it");
  cmd->add_option("--smooth", o->smooth, "Tolerance of the outlines in pixels")
      ->check(CLI::Range(0.0, 100.0));
  cmd->add_option("--truth", o->truth, "Mask of an observer to compare with");
  cmd->add_option("--set", o->settings, "Change a value, for example min_width_px=6")
      ->take_all()
      ->allow_extra_args(false);
  cmd->add_flag("--json", o->json, "Result for machines");
  cmd->callback([o, &action] { action = [o](const Context&) { return segment(*o); }; });
}

}  // namespace

void add_map(CLI::App& app, Action& action) {
  CLI::App* map = app.add_subcommand("map", "Look at maps, check, convert and make them");
  map->require_subcommand(1);

  auto o = std::make_shared<Options>();
  CLI::App* info_cmd = map->add_subcommand("info", "Size, walls, hash");
  add_input(info_cmd, o);
  info_cmd->add_flag("--json", o->json, "Result for machines");
  info_cmd->callback([o, &action] { action = [o](const Context&) { return info(*o); }; });

  auto resolution = std::make_shared<double>(0);
  CLI::App* check_cmd = map->add_subcommand("check", "Pieces, narrowest passage, what fits");
  add_input(check_cmd, o);
  check_cmd->add_option("--resolution", *resolution, "Grid spacing of the search in µm; 0: chosen")
      ->check(CLI::Range(0.0, 1e6));
  check_cmd->add_flag("--json", o->json, "Result for machines");
  check_cmd->callback(
      [=, &action] { action = [=](const Context&) { return check(*o, *resolution); }; });

  auto out = std::make_shared<std::string>();
  auto cell = std::make_shared<double>(0);
  CLI::App* convert_cmd = map->add_subcommand("convert", "Write the map in another form");
  add_input(convert_cmd, o);
  convert_cmd->add_option("out", *out, "File to write: .geojson, .png, .map or .yaml")->required();
  convert_cmd->add_option("--cell", *cell, "Side of a pixel or cell in µm")
      ->check(CLI::Range(0.0, 1e6));
  convert_cmd->callback(
      [=, &action] { action = [=](const Context&) { return convert(*o, *out, *cell); }; });

  add_segment(map, action);
}

}  // namespace microswarm::cli
