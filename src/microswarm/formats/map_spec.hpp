// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "microswarm/core/fields/fields.hpp"
#include "microswarm/geometry/vec2.hpp"

namespace microswarm::formats {

/// Which pixels of an image are free.
enum class FreePixels { bright, dark };
constexpr auto enum_names(FreePixels) {
  return std::array<std::pair<FreePixels, std::string_view>, 2>{
      {{FreePixels::bright, "bright"}, {FreePixels::dark, "dark"}}};
}

/// Image whose pixels are free or walls; (0, 0) is its lower left corner.
struct ImageMap {
  static constexpr std::string_view type_name = "image";
  std::string file{};
  double um_per_px = 1;
  int threshold = 128;
  FreePixels free = FreePixels::bright;
  double simplify = 0;
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.file, plain("file", "PNG, JPEG, BMP, TIFF, PGM or PPM image.").needed());
    visit(self.um_per_px,
          plain("um_per_px", 1e-6, 1e6, "Scale of the image: side of a pixel in µm.").needed());
    visit(self.threshold, plain("threshold", 0, 255, "Grey value from which a pixel is bright."));
    visit(self.free, plain("free", "Free pixels: bright or dark."));
    visit(self.simplify, um("simplify", 0, 1e6, "Tolerance of the outlines; 0: exact."));
  }
};

/// Map of ROS' map_server: YAML and image. Occupied and unknown cells are walls.
struct RosMap {
  static constexpr std::string_view type_name = "ros";
  std::string file{};
  double um_per_m = 1e6;
  bool unknown_free = false;
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.file, plain("file", "YAML file with the key `image`.").needed());
    visit(self.um_per_m,
          plain("um_per_m", 1e-3, 1e9, "µm for a metre of the file; 1e6: true to scale."));
    visit(self.unknown_free, plain("unknown_free", "Treat unknown cells as free, not as walls."));
  }
};

/// Grid map of the MovingAI benchmarks; (0, 0) is its lower left corner.
struct MovingAiMap {
  static constexpr std::string_view type_name = "moving_ai";
  std::string file{};
  double um_per_cell = 1;
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.file, plain("file", "MovingAI .map file.").needed());
    visit(self.um_per_cell, plain("um_per_cell", 1e-6, 1e6, "Side of a cell in µm."));
  }
};

/// Polygons, discs and lines with a width in GeoJSON.
struct GeoJsonMap {
  static constexpr std::string_view type_name = "geojson";
  std::string file{};
  std::optional<double> um_per_unit = std::nullopt;
  double line_width = 0;
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.file, plain("file", "GeoJSON file in plane coordinates.").needed());
    visit(self.um_per_unit, plain("um_per_unit", 1e-9, 1e9,
                                  "µm for a unit of the file; none: 1, or as the file says."));
    visit(self.line_width,
          um("line_width", 0, 1e6, "Width of lines that have none; 0: such lines are refused."));
  }
};

/// Which cells of a matrix are walls.
enum class MatrixWall { zero, one };
constexpr auto enum_names(MatrixWall) {
  return std::array<std::pair<MatrixWall, std::string_view>, 2>{
      {{MatrixWall::zero, "zero"}, {MatrixWall::one, "one"}}};
}

/// Text of zeros and ones, the upper row first; (0, 0) is its lower left corner.
struct MatrixMap {
  static constexpr std::string_view type_name = "matrix";
  std::string file{};
  double um_per_cell = 1;
  std::optional<MatrixWall> wall = std::nullopt;
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.file, plain("file", "Text of rows of 0 and 1, between blanks or commas.").needed());
    visit(self.um_per_cell, plain("um_per_cell", 1e-6, 1e6, "Side of a cell in µm.").needed());
    visit(self.wall, plain("wall", "Cells that are walls: zero or one; none: zero, with a note."));
  }
};

/// Drawing in SVG, as it looks in front of white: dark is a wall. Its lower left corner is (0, 0).
struct SvgMap {
  static constexpr std::string_view type_name = "svg";
  std::string file{};
  std::optional<double> um_per_unit = std::nullopt;
  std::optional<double> um_per_px = std::nullopt;
  int threshold = 128;
  FreePixels free = FreePixels::bright;
  double simplify = 0;
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.file, plain("file", "SVG drawing.").needed());
    visit(self.um_per_unit, plain("um_per_unit", 1e-9, 1e9,
                                  "µm for a unit of the drawing; none: as its size in mm says."));
    visit(self.um_per_px, plain("um_per_px", 1e-6, 1e6,
                                "Largest pixel it is drawn with, in µm; none: 2000 a side."));
    visit(self.threshold, plain("threshold", 0, 255, "Grey value from which a pixel is bright."));
    visit(self.free, plain("free", "Free pixels: bright or dark."));
    visit(self.simplify, um("simplify", 0, 1e6, "Tolerance of the outlines; 0: exact."));
  }
};

/// Rectangular walls, in a list or in a CSV file with rows x,y,width,height [µm].
struct RectanglesMap {
  static constexpr std::string_view type_name = "rectangles";
  std::optional<Vec2> lo = std::nullopt;
  std::optional<Vec2> hi = std::nullopt;
  std::vector<std::vector<double>> rectangles{};
  std::string file{};
  double um_per_unit = 1;
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.lo, um("lo", "Lower left corner of the map; none: of the walls."));
    visit(self.hi, um("hi", "Upper right corner of the map; none: of the walls."));
    visit(self.rectangles, um("rectangles", "Walls: lower left x, y, width, height of each."));
    visit(self.file, plain("file", "CSV of more walls: x,y,width,height in µm."));
    visit(self.um_per_unit, plain("um_per_unit", 1e-9, 1e9, "µm for a unit of the CSV file."));
  }
};

/// One round wall.
struct DiscWall {
  Vec2 centre{};
  double radius = 1;
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.centre, um("centre", "Centre of the disc.").needed());
    visit(self.radius, um("radius", 1e-3, 1e6, "Radius of the disc.").needed());
  }
};

/// Walls given directly as polygons and discs.
struct PolygonsMap {
  static constexpr std::string_view type_name = "polygons";
  Vec2 lo{};
  Vec2 hi{};
  std::vector<std::vector<Vec2>> walls{};
  std::vector<DiscWall> discs{};
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.lo, um("lo", "Lower left corner of the map."));
    visit(self.hi, um("hi", "Upper right corner of the map.").needed());
    visit(self.walls, um("walls", "Outline of each wall: a list of points."));
    visit(self.discs, plain("discs", "Round walls."));
  }
};

/// Channel in a solid block from (0, 0) to (width, height): a DeformingChannel at rest.
struct ChannelMap {
  static constexpr std::string_view type_name = "channel";
  double width = 2000;
  double height = 1000;
  std::vector<Vec2> centre_line{};
  double half_width = 200;
  double end_half_width = 200;
  double end_length = 300;
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.width, um("width", 1, 1e6, "Width of the map.").needed());
    visit(self.height, um("height", 1, 1e6, "Height of the map.").needed());
    visit(self.centre_line, um("centre_line", "Centre line of the channel; smoothed.").needed());
    visit(self.half_width, um("half_width", 1, 1e6, "Half of the channel's width."));
    visit(self.end_half_width, um("end_half_width", 1, 1e6, "Half of the width at the ends."));
    visit(self.end_length, um("end_length", 0, 1e6, "Length over which an end widens."));
  }
};

/// Source of a map: a file in one of the supported formats, or walls given directly.
using MapSpec = std::variant<PolygonsMap, RectanglesMap, ChannelMap, ImageMap, RosMap, MovingAiMap,
                             GeoJsonMap, MatrixMap, SvgMap>;

}  // namespace microswarm::formats
