// SPDX-License-Identifier: Apache-2.0
#include "microswarm/formats/svg/svg.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/text/file.hpp"
#include "microswarm/core/text/text.hpp"
#include "microswarm/formats/svg/renderer.hpp"

namespace microswarm::formats {
namespace {

constexpr std::uint64_t max_svg_bytes = 64ULL << 20;
constexpr double default_side = 2000;  // [px]

/// Width and height [µm].
std::pair<double, double> size_um(const SvgSize& size, std::optional<double> um_per_unit,
                                  const std::string& name) {
  if (um_per_unit) return {*um_per_unit * size.width, *um_per_unit * size.height};
  if (size.width_um && size.height_um) return {*size.width_um, *size.height_um};
  throw InputError(name +
                   ": its size is not in mm, cm, in, pt or pc: give um_per_unit (--um-per-unit), "
                   "the µm for a unit of the drawing");
}

}  // namespace

SvgPicture draw_svg(std::string_view text, std::string_view name, std::optional<double> um_per_unit,
                    std::optional<double> um_per_px) {
  const std::string file(name);
  const SvgRenderer& renderer = svg_renderer();
  const SvgSize size = renderer.measure(text);
  if (!size.error.empty()) throw InputError(file + ": no SVG: " + one_line(size.error));
  SvgPicture picture;
  std::tie(picture.width, picture.height) = size_um(size, um_per_unit, file);
  const auto is_size = [](double side) { return side > 0 && side <= 1e9; };
  if (!is_size(picture.width) || !is_size(picture.height))
    throw InputError(
        fmt::format("{}: a drawing of {:.4g} × {:.4g} µm, a side must be above 0 and "
                    "at most 1e9",
                    name, picture.width, picture.height));
  picture.um_per_px = um_per_px.value_or(std::max(picture.width, picture.height) / default_side);
  // A side of whole pixels may be a bit more by rounding.
  const auto pixels = [&](double side) { return std::ceil(side / picture.um_per_px - 1e-6); };
  constexpr double far_too_many = 1e9;
  const auto columns = static_cast<int>(std::clamp(pixels(picture.width), 1.0, far_too_many));
  const auto rows = static_cast<int>(std::clamp(pixels(picture.height), 1.0, far_too_many));
  check_image_size(columns, rows, name);
  SvgPixels drawn = renderer.draw(text, picture.width / picture.um_per_px,
                                  picture.height / picture.um_per_px, columns, rows);
  if (!drawn.error.empty()) throw InputError(file + ": cannot draw it: " + one_line(drawn.error));
  picture.image = {columns, rows, 1, std::move(drawn.grey)};
  if (!um_per_px)
    picture.notes.push_back(fmt::format(
        "{}: {:.4g} × {:.4g} µm, drawn with pixels of {:.4g} µm: give um_per_px (--um-per-px) for "
        "finer ones",
        name, picture.width, picture.height, picture.um_per_px));
  return picture;
}

std::string lost_ink_note(const SvgPicture& drawn, const Mask& walls, std::uint8_t blank,
                          const std::string& name) {
  std::int64_t lost = 0;
  double ink = 0;
  Vec2 first;
  for (int row = 0; row < walls.height; ++row)
    for (int column = 0; column < walls.width; ++column) {
      const int grey = drawn.image.pixels[drawn.image.index(column, row)];
      if (grey == blank) continue;
      bool beside_wall = false;
      for (int r = std::max(0, row - 1); r <= std::min(walls.height - 1, row + 1); ++r)
        for (int c = std::max(0, column - 1); c <= std::min(walls.width - 1, column + 1); ++c)
          beside_wall = beside_wall || walls.at(c, r);
      if (beside_wall) continue;
      if (lost++ == 0)
        first = drawn.um_per_px * Vec2{column + 0.5, -row - 0.5} + Vec2{0, drawn.height};
      ink += std::abs(blank - grey) / 255.0;
    }
  if (lost == 0) return {};
  return fmt::format(
      "{}: {} pixels with some ink are free, the first at ({:.6g}, {:.6g}) µm: lines thinner than "
      "a pixel of {:.4g} µm, or pale fills; um_per_px (--um-per-px) of about {:.2g} keeps such "
      "lines, map.threshold such fills",
      name, lost, first.x, first.y, drawn.um_per_px,
      0.9 * drawn.um_per_px * ink / static_cast<double>(lost));
}

SvgPicture draw_svg_file(const std::filesystem::path& path, std::optional<double> um_per_unit,
                         std::optional<double> um_per_px) {
  return draw_svg(read_file(path, max_svg_bytes), path.string(), um_per_unit, um_per_px);
}

}  // namespace microswarm::formats
