// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <numbers>

#include "microswarm/config/write.hpp"
#include "microswarm/config/yaml.hpp"
#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/text/file.hpp"
#include "microswarm/core/text/text.hpp"
#include "microswarm/formats/images/image.hpp"
#include "microswarm/vision/calibration/calibration_grid.hpp"
#include "microswarm/vision/calibration/lens_distortion.hpp"
#include "rig/camera/still.hpp"
#include "rig/commissioner.hpp"
#include "rig/rig.hpp"
#include "support/options.hpp"

namespace microswarm::cli {
namespace {

using Json = nlohmann::ordered_json;

struct ScaleOptions {
  std::string picture;
  std::string rig;
  std::vector<std::string> settings;
  std::string points;
  std::optional<double> distance;
  std::string grid;
  std::optional<double> pitch;
  std::string pattern = "dots";
  std::string origin;
  bool mirrored = false;
  std::string out;
  std::string by;
  bool json = false;
};

/// The key `scale` of a rig file.
struct ScalePiece {
  vision::CameraScale scale;
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.scale, plain("scale", "Position and scale of the camera in the world."));
  }
};

std::optional<Vec2> chosen_origin(const ScaleOptions& o) {
  if (o.origin.empty()) return std::nullopt;
  constexpr double farthest = 1e6;  // [px], as in a rig file
  const std::vector<double> v = numbers(o.origin);
  for (const double x : v)
    if (std::abs(x) > farthest)
      throw InputError(
          fmt::format("--origin: is {} px, allowed -{:g}..{:g}", o.origin, farthest, farthest));
  return Vec2{v[0], v[1]};
}

/// A scale and, from a grid, the lens distortion.
struct FoundScale {
  vision::FittedScale fit;
  std::optional<vision::LensDistortion> lens;
};

FoundScale from_points(const ScaleOptions& o, const formats::Image& picture) {
  if (!o.distance) throw InputError("rig scale: --points needs --distance");
  const std::vector<double> v = numbers(o.points);
  const Vec2 a{v[0], v[1]}, b{v[2], v[3]};
  for (const Vec2 p : {a, b})
    if (p.x < -0.5 || p.y < -0.5 || p.x > picture.width - 0.5 || p.y > picture.height - 0.5)
      throw InputError(fmt::format("--points: {:.6g},{:.6g} is outside {}, which is {} × {} px",
                                   p.x, p.y, o.picture, picture.width, picture.height));
  const vision::CameraScale scale =
      vision::scale_of_distance(a, b, *o.distance, picture.height, chosen_origin(o), !o.mirrored);
  return {.fit = {.scale = scale, .residuals = {}}, .lens = {}};
}

FoundScale from_grid(const ScaleOptions& o, const formats::Image& picture) {
  if (!o.pitch) throw InputError("rig scale: --grid needs --pitch");
  vision::GridParams params{.pattern = *enum_value<vision::GridPattern>(o.pattern),
                            .pitch = *o.pitch};
  int used = 0;
  if (std::sscanf(o.grid.c_str(), "%dx%d%n", &params.columns, &params.rows, &used) != 2 ||
      used != std::ssize(o.grid) || params.columns < 2 || params.rows < 2 ||
      params.columns > 1000 || params.rows > 1000)
    throw InputError("--grid: must be COLUMNSxROWS, 2 to 1000 each, not " + quote(o.grid));
  std::vector<vision::ScalePoint> points;
  try {
    points = vision::find_grid(picture, params);
  } catch (const InputError& error) {
    throw InputError(error.issues().placed_in(o.picture));
  }
  if (o.mirrored)  // the grid is mirrored, too
    for (vision::ScalePoint& p : points)
      p.position.y = (params.rows - 1) * params.pitch - p.position.y;
  vision::FittedScale fit = vision::fit_scale(points, !o.mirrored);
  if (fit.worst > 0.25 * params.pitch)
    throw InputError(o.picture, fmt::format("a point is {:.3g} µm off a grid of {:.6g} µm",
                                            fit.worst, params.pitch));
  if (const auto origin = chosen_origin(o)) fit.scale.origin_px = *origin;
  return {fit, vision::fit_distortion(points, !o.mirrored, picture.width, picture.height)};
}

Json json_of_lens(const vision::LensDistortion& lens) {
  return {{"k1", lens.k1},
          {"corner_shift_px", lens.shift_px},
          {"standard_deviation_px", lens.deviation_px},
          {"corner_error_px", lens.error_px},
          {"rms_um_without", lens.rms},
          {"found", lens.is_found()}};
}

void tell_lens(const vision::LensDistortion& lens) {
  if (!lens.is_found()) {
    print("# no lens distortion stands out: {:.2g} ± {:.2g} px in the corners\n", lens.shift_px,
          lens.deviation_px);
    return;
  }
  print(
      "# lens distortion: {}, moves the corners by {:.3g} ± {:.2g} px (k1 {:.3g}, 1 in the "
      "corners)\n# with this scale positions are up to {:.3g} px off in the corners; without the "
      "distortion the RMS residual is {:.3g} µm\n",
      lens.k1 > 0 ? "barrel" : "pincushion", lens.shift_px, lens.deviation_px, lens.k1,
      lens.error_px, lens.rms);
}

formats::Image picture_for(const ScaleOptions& o) {
  return take_picture(o.picture, find_camera(o.picture, o.rig, o.settings));
}

int scale(const ScaleOptions& o) {
  for (const std::string& input : {o.picture, o.rig}) keep_input(o.out, input);
  if (o.points.empty() == o.grid.empty())
    throw InputError("rig scale: give either --points or --grid");
  const formats::Image picture = picture_for(o);
  const auto [fit, lens] = o.grid.empty() ? from_points(o, picture) : from_grid(o, picture);
  const vision::CameraScale& s = fit.scale;
  const std::string yaml = to_yaml(ScalePiece{s});
  if (!o.out.empty()) write_file_atomically(o.out, yaml);
  if (!o.out.empty() && !o.rig.empty())
    commission(o.rig, {rig::commissioning_entry(
                          rig::Quantity::scale,
                          fmt::format("{:.5g} µm a pixel, rotation {:.2f}°", s.um_per_px,
                                      s.rotation * 180 / std::numbers::pi),
                          commissioner(o.by), rig::key_fingerprint(s))});
  if (o.json) {
    Json json{{"scale",
               {{"um_per_px", s.um_per_px},
                {"rotation_deg", s.rotation * 180 / std::numbers::pi},
                {"y_up", s.y_up},
                {"origin_px", {s.origin_px.x, s.origin_px.y}}}},
              {"points", fit.residuals.size()}};
    if (!fit.residuals.empty()) {
      json["rms_um"] = fit.rms;
      json["worst_um"] = fit.worst;
      if (lens) json["lens_distortion"] = json_of_lens(*lens);
    }
    print("{}\n", json.dump(2));
    return ok;
  }
  print("{}", yaml);
  print("# the picture shows {:.1f} × {:.1f} µm\n", picture.width * s.um_per_px,
        picture.height * s.um_per_px);
  if (!fit.residuals.empty())
    print("# {} points, RMS residual {:.3g} µm ({:.3g} px), the worst {:.3g} µm\n",
          fit.residuals.size(), fit.rms, fit.rms / s.um_per_px, fit.worst);
  if (lens) tell_lens(*lens);
  if (!o.out.empty()) print("# wrote {}\n", o.out);
  return ok;
}

}  // namespace

void add_rig_scale(Command rig, Action& action) {
  auto o = std::make_shared<ScaleOptions>();
  Command cmd =
      rig.add_command("scale", "Determine µm per pixel of a camera from two points or a grid",
                      "rig scale samples/rig/grid.png --grid 9x6 --pitch 100 --pattern chessboard "
                      "--out scale.yaml");
  cmd.add_option("picture", o->picture,
                 "Picture from the camera, or camera such as /dev/video0 or genicam:ID")
      .required()
      .type_name("FILE")
      .input();
  cmd.add_option("--rig", o->rig, "Use the camera's settings of this rig (YAML)")
      .type_name("FILE")
      .input("rigs");
  add_settings(cmd, o->settings, "Override a setting of the camera, e.g. width_px=1280",
               type_of<vision::CameraParams>);
  const Option points =
      cmd.add_option("--points", o->points, "Two points in the picture in px, y down")
          .type_name("X1,Y1,X2,Y2")
          .check({[](const std::string& text) -> std::string {
            if (numbers(text).size() == 4) return {};
            return "must be X1,Y1,X2,Y2, not " + quote(text);
          }});
  cmd.add_option("--distance", o->distance, "Distance between the two points in µm")
      .type_name("NUMBER")
      .check(number(1e-3, 1e7))
      .needs(points);
  const Option grid =
      cmd.add_option("--grid", o->grid,
                     "Grid points of a calibration slide, e.g. 9x6; inner corners of a chessboard")
          .type_name("COLUMNSxROWS")
          .excludes(points);
  cmd.add_option("--pitch", o->pitch, "Distance between neighbouring grid points in µm")
      .type_name("NUMBER")
      .check(number(1e-3, 1e6))
      .needs(grid);
  cmd.add_option("--pattern", o->pattern, "Kind of grid points")
      .type_name("WORD")
      .check(any_word({"dots", "chessboard"}))
      .needs(grid);
  cmd.add_option("--origin", o->origin, "World origin in the picture in px")
      .type_name("X,Y")
      .default_text("lower left corner, upper left if mirrored, or the grid's first point")
      .check(place(2, "X,Y"));
  cmd.add_flag("--mirrored", o->mirrored, "World y points down in the picture");
  cmd.add_option("--out", o->out, "Write the scale to this file (YAML), for use in a rig file")
      .type_name("FILE");
  add_by(cmd, o->by);
  add_json(cmd, o->json);
  cmd.callback([o, &action] { action = [o](const Context&) { return scale(*o); }; });
}

}  // namespace microswarm::cli
