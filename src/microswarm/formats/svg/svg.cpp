// SPDX-License-Identifier: Apache-2.0
#include "microswarm/formats/svg/svg.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/errors/input_names.hpp"
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
  throw InputError(name, "its size is not in mm, cm, in, pt or pc: give " +
                             input_name("um_per_unit") + ", the µm for a unit of the drawing");
}

bool is_svg_blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; }

/// Number of elements of a name, with or without a prefix svg:, that name another file.
int links(std::string_view text, std::string_view name) {
  int count = 0;
  for (const std::string& element : {fmt::format("<{}", name), fmt::format("<svg:{}", name)})
    for (std::size_t at = text.find(element); at != std::string_view::npos;
         at = text.find(element, at + 1)) {
      const std::string_view tag = text.substr(at, text.find('>', at) - at);
      if (tag.size() == element.size() || !is_svg_blank(tag[element.size()])) continue;
      const std::size_t href = tag.find("href");
      const std::size_t open = href == tag.npos ? href : tag.find_first_of("\"'", href);
      if (open == tag.npos) continue;
      const std::string_view target = tag.substr(std::min(open + 1, tag.size()));
      const std::size_t first = std::min(target.find_first_not_of(" \t\r\n"), target.size());
      count += !target.substr(first).starts_with('#') && !target.substr(first).starts_with("data:");
    }
  return count;
}

/// Number of places where a text stands.
int occurrences(std::string_view text, std::string_view part) {
  int count = 0;
  for (std::size_t at = text.find(part); at != text.npos; at = text.find(part, at + 1)) ++count;
  return count;
}

void note_links(std::string_view text, std::string_view name, std::vector<std::string>& notes) {
  const auto note = [&](int count, std::string_view what) {
    if (count > 0)
      notes.push_back(fmt::format("{}: {} of its {} in other files, which are not read: embed them",
                                  name, count, what));
  };
  note(links(text, "image") + links(text, "feImage"), "pictures are");
  note(links(text, "use"), "elements <use> name drawings");
  note(occurrences(text, "<?xml-stylesheet") + occurrences(text, "@import"), "style sheets are");
}

/// The drawing with "100mm" for "100 mm" in the size of its root, which is no length in SVG.
std::string with_joined_units(std::string_view text) {
  std::string drawing(text);
  const std::size_t root = std::min(drawing.find("<svg"), drawing.size());
  for (const std::string_view side : {"width", "height"}) {
    const std::size_t end = std::min(drawing.find('>', root), drawing.size());
    std::size_t at = drawing.find(side, root);
    while (at < end && (at == 0 || !is_svg_blank(drawing[at - 1]))) at = drawing.find(side, at + 1);
    if (at >= end) continue;
    const std::size_t open = drawing.find_first_not_of(" \t\r\n=", at + side.size());
    if (open >= end || (drawing[open] != '"' && drawing[open] != '\'')) continue;
    const std::size_t close = drawing.find(drawing[open], open + 1);
    if (close >= end) continue;
    std::string value = drawing.substr(open + 1, close - open - 1);
    std::erase_if(value, is_svg_blank);
    drawing.replace(open + 1, close - open - 1, value);
  }
  return drawing;
}

}  // namespace

SvgPicture draw_svg(std::string_view drawing, std::string_view name,
                    std::optional<double> um_per_unit, std::optional<double> um_per_px) {
  const std::string file(name);
  const std::string text = with_joined_units(drawing);
  const SvgRenderer& renderer = svg_renderer();
  const SvgSize size = renderer.measure(text);
  if (!size.error.empty()) throw InputError(file, "no SVG: " + one_line(size.error));
  SvgPicture picture;
  std::tie(picture.width, picture.height) = size_um(size, um_per_unit, file);
  const auto is_size = [](double side) { return side > 0 && side <= 1e9; };
  if (!is_size(picture.width) || !is_size(picture.height))
    throw InputError(std::string(name),
                     fmt::format("a drawing of {:.4g} × {:.4g} µm, a side must be above 0 and "
                                 "at most 1e9",
                                 picture.width, picture.height));
  picture.um_per_px = um_per_px.value_or(std::max(picture.width, picture.height) / default_side);
  // A side of whole pixels may be a bit more by rounding.
  const auto pixels = [&](double side) { return std::ceil(side / picture.um_per_px - 1e-6); };
  constexpr double far_too_many = 1e9;
  const auto columns = static_cast<int>(std::clamp(pixels(picture.width), 1.0, far_too_many));
  const auto rows = static_cast<int>(std::clamp(pixels(picture.height), 1.0, far_too_many));
  check_image_size(columns, rows, name);
  SvgPixels drawn = renderer.draw(text, picture.width / picture.um_per_px,
                                  picture.height / picture.um_per_px, columns, rows);
  if (!drawn.error.empty()) throw InputError(file, "cannot draw it: " + one_line(drawn.error));
  picture.image = {columns, rows, 1, std::move(drawn.grey)};
  note_links(text, name, picture.notes);
  if (!um_per_px)
    picture.notes.push_back(fmt::format(
        "{}: {:.4g} × {:.4g} µm, drawn with pixels of {:.4g} µm: give {} for finer "
        "ones",
        name, picture.width, picture.height, picture.um_per_px, input_name("um_per_px")));
  return picture;
}

}  // namespace microswarm::formats
