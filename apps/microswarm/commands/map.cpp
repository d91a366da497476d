// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "microswarm/config/yaml.hpp"
#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/fields/overloaded.hpp"
#include "microswarm/core/text/file.hpp"
#include "microswarm/formats/choose_map_spec.hpp"
#include "microswarm/formats/map_file.hpp"
#include "microswarm/formats/write_map.hpp"
#include "microswarm/vision/image/overlay.hpp"
#include "microswarm/vision/vessels/agreement.hpp"
#include "microswarm/vision/vessels/channel_graph.hpp"
#include "microswarm/vision/vessels/vessel_map.hpp"
#include "microswarm/world/connectivity/passage.hpp"
#include "rig/camera/still.hpp"
#include "support/options.hpp"

namespace microswarm::cli {
namespace {

using Json = nlohmann::ordered_json;

struct MapOptions {
  MapInput map;
  std::vector<std::string> settings;
  bool json = false;
};

void add_input(Command cmd, const std::shared_ptr<MapOptions>& o) {
  add_map_input(cmd, o->map);
  add_settings(cmd, o->settings, "Set how the map is read, e.g. map.free=dark",
               type_of<formats::MapKey>);
}

formats::LoadedMap load(const MapOptions& o) {
  for (const Setting& setting : Settings(other_settings(o.settings), "--set").list)
    throw InputError(setting_location("--set", setting.key), "only keys within 'map' are set");
  return load_map(o.map, o.settings);
}

int info(const MapOptions& o) {
  const formats::LoadedMap loaded = load(o);
  const Box& b = loaded.map->bounds();
  const auto bodies = loaded.map->walls().bodies();
  std::size_t vertices = 0;
  std::size_t discs = 0;
  for (const Body& body : bodies)
    std::visit(Overloaded{[&](const Disc&) { ++discs; },
                          [&](const Polygon& polygon) {
                            vertices += polygon.outer.size();
                            for (const auto& hole : polygon.holes) vertices += hole.size();
                          }},
               body.shape);
  if (o.json)
    print("{}\n", Json{{"lo_um", {b.lo.x, b.lo.y}},
                       {"hi_um", {b.hi.x, b.hi.y}},
                       {"walls", bodies.size()},
                       {"discs", discs},
                       {"vertices", vertices},
                       {"hash", fmt::format("{:016x}", loaded.input_hash)},
                       {"notes", loaded.notes}}
                      .dump(2));
  else
    print(
        "{}: {:g} × {:g} µm (x {:g}..{:g}, y {:g}..{:g}), {} walls ({} of them discs, {} "
        "vertices), "
        "hash {:016x}\n",
        o.map.file, b.width(), b.height(), b.lo.x, b.hi.x, b.lo.y, b.hi.y, bodies.size(), discs,
        vertices, loaded.input_hash);
  return ok;
}

int check(const MapOptions& o, double resolution) {
  const formats::LoadedMap loaded = load(o);
  const MapReport r = check_map(*loaded.map, resolution);
  if (r.free_pieces == 0) throw InputError(o.map.file, "all of the map is blocked");
  if (o.json) {
    print("{}\n", Json{{"wall_pieces", r.wall_pieces},
                       {"free_area_um2", r.free_area},
                       {"free_pieces", r.free_pieces},
                       {"region_areas_um2", r.region_areas},
                       {"widest_um", r.widest},
                       {"narrowest_passage_um", r.narrowest_passage},
                       {"resolution_um", r.resolution},
                       {"notes", loaded.notes}}
                      .dump(2));
    return ok;
  }
  print("wall pieces: {}\nfree pieces: {}, {:.0f} µm² in all, the largest has {:.1f} % of it\n",
        r.wall_pieces, r.free_pieces, r.free_area, 100 * r.region_areas[0] / r.free_area);
  print("narrowest passage of the largest piece: {:.1f} µm, or up to {:.1f} µm more",
        r.narrowest_passage, 1.5 * r.resolution);
  if (r.passages.empty())
    print(" (it is one room)\n");
  else
    print(", at ({:.0f}, {:.0f}) µm\n", r.passages[0].position.x, r.passages[0].position.y);
  print(
      "a swarm of up to {:.1f} µm radius gets from room to room there (ends that taper off are no "
      "rooms), up to {:.1f} µm fits somewhere\n",
      0.5 * r.narrowest_passage, 0.5 * r.widest);
  return ok;
}

int convert(const MapOptions& o, const std::string& out, const std::optional<double>& cell) {
  formats::write_map(out, *load(o).map, cell ? *cell : o.map.um_per_px.value_or(0));
  print("wrote {}\n", out);
  return ok;
}

struct GraphOptions {
  std::string out = "graph";
  double cell = 0;
};

/// Writes the skeleton of the map's channels as tables of branches and nodes.
int graph(const MapOptions& o, const GraphOptions& how, const Context& context) {
  const formats::LoadedMap loaded = load(o);
  const vision::ChannelGraph found = vision::channel_graph(*loaded.map, how.cell, context.stop);
  if (context.stop()) {
    note("interrupted: nothing was written\n");
    return not_reached;
  }
  if (found.nodes.empty()) throw InputError(o.map.file, "all of the map is blocked");
  const std::filesystem::path out = how.out;
  if (!out.parent_path().empty()) make_folder(out.parent_path().string());
  const std::string branches = out.string() + "-branches.csv";
  const std::string nodes = out.string() + "-nodes.csv";
  write_file_atomically(branches, vision::branch_table(found));
  write_file_atomically(nodes, vision::node_table(found));
  double length = 0;
  double area = 0;
  for (const vision::ChannelBranch& branch : found.branches) {
    length += branch.length;
    area += branch.length * branch.mean_width;
  }
  const int networks = std::ranges::max(found.nodes, {}, &vision::ChannelNode::network).network;
  const Json mean_width = length > 0 ? Json(area / length) : Json(nullptr);
  if (o.json) {
    print("{}\n", Json{{"branches", found.branches.size()},
                       {"nodes", found.nodes.size()},
                       {"networks", networks},
                       {"length_um", length},
                       {"mean_width_um", mean_width},
                       {"cell_um", found.cell},
                       {"branch_table", branches},
                       {"node_table", nodes}}
                      .dump(2));
    return ok;
  }
  print("{} branches of {:.0f} µm in all", found.branches.size(), length);
  if (length > 0) print(", {:.1f} µm wide on average", area / length);
  print(", {} nodes, {} networks; cells of {:.3g} µm: channels below {:.3g} µm may be cut\n",
        found.nodes.size(), networks, found.cell, 3 * found.cell);
  print("wrote {} and {}\n", branches, nodes);
  return ok;
}

struct SegmentOptions {
  std::string photo;
  std::string rig;
  std::string out = "vessels.geojson";
  std::string truth;
  std::vector<std::string> settings;
  std::optional<double> um_per_px;
  double smooth = 1.0;
  bool json = false;
};

std::string share(const std::optional<double>& v) { return v ? fmt::format("{:.3f}", *v) : "–"; }
Json json_share(const std::optional<double>& v) { return v ? Json(*v) : Json(nullptr); }

/// The ground-truth mask; empty without a file.
std::optional<formats::Mask> read_truth(const std::string& file, const formats::Image& photo) {
  if (file.empty()) return std::nullopt;
  formats::Mask mask = formats::threshold(read_photo(file), 128, false);
  if (mask.width != photo.width || mask.height != photo.height)
    throw InputError(file, fmt::format("{}x{} pixels, the photograph has {}x{}", mask.width,
                                       mask.height, photo.width, photo.height));
  return mask;
}

int segment(const SegmentOptions& o, const Context& context) {
  vision::VesselParams params;
  note_each(set_values(params, {o.settings, "--set"}));
  if (!o.um_per_px && is_camera(o.photo))
    throw InputError(o.photo, "µm per px is missing: give --um-per-px");
  std::optional<double> um_per_px = o.um_per_px;
  const formats::Image photo = take_picture(o.photo, find_camera(o.photo, o.rig), um_per_px);
  if (!um_per_px) throw InputError(o.photo, "µm per px is missing: give --um-per-px");
  const std::optional<formats::Mask> truth = read_truth(o.truth, photo);
  const double cell = *um_per_px;
  const auto interrupted = [&] {
    if (context.stop()) note("interrupted: nothing was written\n");
    return context.stop();
  };
  const vision::VesselSegmentation found = vision::segment_vessels(photo, params, context.stop);
  if (interrupted()) return not_reached;
  const Map map = vision::vessel_map(found, cell, o.smooth, o.photo, context.stop);
  if (interrupted()) return not_reached;
  std::vector<std::string> notes;
  if (const std::string faint = vision::note_on_noise(found); !faint.empty())
    notes.push_back(o.photo + ": " + faint);
  note_each(notes);
  const std::filesystem::path out = o.out;
  std::filesystem::path picture = out;
  picture.replace_filename(out.stem().string() + "-overlay.png");
  if (!out.parent_path().empty()) make_folder(out.parent_path().string());
  formats::write_map(out, map, cell);
  formats::write_png(picture, vision::overlay(photo, found.vessels));

  Json json{{"method", std::string(enum_name(found.method))},
            {"polarity", std::string(enum_name(found.polarity))},
            {"two_level_share", json_share(found.two_level_share)},
            {"polarity_odds", json_share(found.polarity_odds)},
            {"vessel_share", found.view_share},
            {"pieces", found.pieces},
            {"kept_share", found.kept_share},
            {"bridges", found.bridges},
            {"wide_width_um", found.wide_width_px * cell},
            {"map", out.string()},
            {"overlay", picture.string()},
            {"notes", notes}};
  std::string text = fmt::format(
      "method: {}\nvessels cover {:.1f} % of the view, wide ones {:.0f} µm; {} gaps bridged; kept "
      "{:.0f} % of {} pieces\n",
      vision::describe_choice(found, "--set "), 100 * found.view_share, found.wide_width_px * cell,
      found.bridges, 100 * found.kept_share, found.pieces);
  if (truth) {
    const vision::Agreement a = vision::compare(*truth, found.vessels, &found.field_of_view);
    json["sensitivity"] = json_share(a.sensitivity());
    json["specificity"] = json_share(a.specificity());
    json["dice"] = json_share(a.dice());
    text +=
        fmt::format("against {}: sensitivity {}, specificity {}, Dice {} in the field of view\n",
                    o.truth, share(a.sensitivity()), share(a.specificity()), share(a.dice()));
  }
  if (o.json)
    print("{}\n", json.dump(2));
  else
    print("{}wrote {} and {}\n", text, out.string(), picture.string());
  return ok;
}

void add_segment(Command map, Action& action) {
  auto o = std::make_shared<SegmentOptions>();
  Command cmd = map.add_command(
      "segment", "Segment vessels or channels in a photograph; writes a map and an overlay picture",
      "map segment samples/vessels/retina.png --um-per-px 6 --out vessels.geojson");
  cmd.add_option("photo", o->photo,
                 "Photograph of vessels or channels, or camera such as /dev/video0 or genicam:ID")
      .required()
      .type_name("FILE")
      .input();
  cmd.add_option("--rig", o->rig, "Use the camera's settings of this rig (YAML)").type_name("FILE");
  add_um_per_px(cmd, o->um_per_px, "µm per pixel of the photograph, 1e-6..1e6");
  cmd.add_option("--out", o->out, "Map to write; NAME-overlay.png is written next to it")
      .type_name("FILE");
  cmd.add_option("--smooth", o->smooth, "Tolerance of the outlines in pixels, 0..100")
      .type_name("NUMBER")
      .check(number(0, 100));
  cmd.add_option("--truth", o->truth, "Ground-truth mask (white vessels) to compare with")
      .type_name("FILE");
  add_settings(cmd, o->settings, "Override a value, e.g. min_width_px=6",
               type_of<vision::VesselParams>);
  add_json(cmd, o->json);
  cmd.callback(
      [o, &action] { action = [o](const Context& context) { return segment(*o, context); }; });
}

}  // namespace

void add_map(Command app, Action& action) {
  Command map = app.add_group("map", "Inspect, check, convert and create maps");

  auto o = std::make_shared<MapOptions>();
  Command info_cmd = map.add_command("info", "Print size, walls and hash",
                                     "map info samples/maze.pgm --um-per-px 5");
  add_input(info_cmd, o);
  add_json(info_cmd, o->json);
  info_cmd.callback([o, &action] { action = [o](const Context&) { return info(*o); }; });

  auto resolution = std::make_shared<double>(0);
  Command check_cmd =
      map.add_command("check", "Print free pieces, narrowest passage and fitting swarm radius",
                      "map check scenarios/maps/retina.geojson");
  add_input(check_cmd, o);
  check_cmd
      .add_option("--resolution", *resolution, "Grid spacing of the search in µm; 0: automatic")
      .type_name("NUMBER")
      .check(number(0, 1e6));
  add_json(check_cmd, o->json);
  check_cmd.callback(
      [=, &action] { action = [=](const Context&) { return check(*o, *resolution); }; });

  auto how = std::make_shared<GraphOptions>();
  Command graph_cmd =
      map.add_command("graph", "Measure channels: branches of the skeleton, widths, nodes, as CSV",
                      "map graph scenarios/maps/retina.geojson --out retina");
  add_input(graph_cmd, o);
  graph_cmd.add_option("--out", how->out, "Writes NAME-branches.csv and NAME-nodes.csv")
      .type_name("NAME");
  graph_cmd.add_option("--cell", how->cell, "Resolution in µm; 0: a million cells")
      .type_name("NUMBER")
      .check(number(0, 1e6));
  add_json(graph_cmd, o->json);
  graph_cmd.callback(
      [=, &action] { action = [=](const Context& context) { return graph(*o, *how, context); }; });

  auto out = std::make_shared<std::string>();
  auto cell = std::make_shared<std::optional<double>>();
  Command convert_cmd =
      map.add_command("convert", "Convert a map to another format",
                      "map convert scenarios/maps/retina.geojson retina.png --cell 20");
  add_input(convert_cmd, o);
  convert_cmd
      .add_option("out", *out,
                  fmt::format("File to write: {}", formats::written_map_formats).c_str())
      .required()
      .type_name("FILE");
  convert_cmd.add_option("--cell", *cell, "Pixel or cell size to write in µm")
      .type_name("NUMBER")
      .default_text("--um-per-px")
      .check(number(1e-6, 1e6));
  convert_cmd.callback(
      [=, &action] { action = [=](const Context&) { return convert(*o, *out, *cell); }; });

  add_segment(map, action);
}

}  // namespace microswarm::cli
