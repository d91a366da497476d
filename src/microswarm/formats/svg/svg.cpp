// SPDX-License-Identifier: Apache-2.0
#include "microswarm/formats/svg/svg.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/text/text.hpp"
#include "microswarm/formats/svg/renderer.hpp"

namespace microswarm::formats {
namespace {

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

/// Number of `image` elements that name another file, which is not read.
int linked_pictures(std::string_view text) {
  int linked = 0;
  for (const std::string_view element : {"<image", "<svg:image"})
    for (std::size_t at = text.find(element); at != std::string_view::npos;
         at = text.find(element, at + 1)) {
      const std::string_view tag = text.substr(at, text.find('>', at) - at);
      const std::size_t href = tag.find("href");
      if (href != std::string_view::npos && tag.find("data:", href) == std::string_view::npos)
        ++linked;
    }
  return linked;
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
  if (const int linked = linked_pictures(text); linked > 0)
    picture.notes.push_back(fmt::format(
        "{}: {} of its pictures are in other files, which are not read: embed them", name, linked));
  if (!um_per_px)
    picture.notes.push_back(fmt::format(
        "{}: {:.4g} × {:.4g} µm, drawn with pixels of {:.4g} µm: give um_per_px (--um-per-px) for "
        "finer ones",
        name, picture.width, picture.height, picture.um_per_px));
  return picture;
}

}  // namespace microswarm::formats
