// SPDX-License-Identifier: Apache-2.0
#include "microswarm/formats/svg_walls.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <string_view>
#include <utility>

#include "microswarm/core/errors/input_names.hpp"
#include "microswarm/core/text/file.hpp"
#include "microswarm/formats/picture_walls.hpp"
#include "microswarm/formats/svg/svg.hpp"

namespace microswarm::formats {
namespace {

constexpr std::uint64_t max_svg_bytes = 64ULL << 20;

struct Pixel {
  int column = 0, row = 0;
};

/// Whether `fits` holds for a pixel and all around it that are in the mask.
template <class Fits>
bool all_around(const Mask& mask, Pixel p, Fits&& fits) {
  for (int row = std::max(0, p.row - 1); row <= std::min(mask.height - 1, p.row + 1); ++row)
    for (int column = std::max(0, p.column - 1); column <= std::min(mask.width - 1, p.column + 1);
         ++column)
      if (!fits(Pixel{column, row})) return false;
  return true;
}

/// A drawing with its walls, and the ink that is lost: pixels of another grey than blank ones that
/// are free though no wall is beside them.
struct Drawing {
  SvgPicture picture{};
  Mask walls{};
  std::vector<Pixel> thin{};  ///< lost ink that is nowhere three pixels wide
  std::int64_t lost = 0;      ///< pixels of lost ink
  double ink = 0;             ///< lost, as black pixels
  Pixel first{};              ///< lost pixel
};

Drawing draw(std::string_view text, const SvgMap& spec, const std::string& name,
             std::optional<double> um_per_px) {
  Drawing d;
  d.picture = draw_svg(text, name, spec.um_per_unit, um_per_px);
  d.walls = picture_walls(d.picture.image, spec.threshold, spec.free, name);
  const int blank = spec.free == FreePixels::bright ? 255 : 0;
  const auto grey = [&](Pixel p) {
    return static_cast<int>(d.picture.image.pixels[d.picture.image.index(p.column, p.row)]);
  };
  const auto is_ink = [&](Pixel p) { return grey(p) != blank; };
  const auto is_wide = [&](Pixel p) {
    return !all_around(d.walls, p, [&](Pixel q) { return !all_around(d.walls, q, is_ink); });
  };
  for (int row = 0; row < d.walls.height; ++row)
    for (int column = 0; column < d.walls.width; ++column) {
      const Pixel p{column, row};
      if (!is_ink(p)) continue;
      if (!all_around(d.walls, p, [&](Pixel q) { return !d.walls.at(q.column, q.row); })) continue;
      if (d.lost++ == 0) d.first = p;
      d.ink += std::abs(blank - grey(p)) / 255.0;
      if (!is_wide(p)) d.thin.push_back(p);
    }
  return d;
}

/// Number of these pixels that have a wall in a drawing whose pixels are `factor` times as fine.
std::size_t kept(const std::vector<Pixel>& pixels, const Mask& finer, int factor) {
  const auto has_wall = [&](Pixel p) {
    for (int row = factor * p.row; row < std::min(factor * (p.row + 1), finer.height); ++row)
      for (int c = factor * p.column; c < std::min(factor * (p.column + 1), finer.width); ++c)
        if (finer.at(c, row)) return true;
    return false;
  };
  return static_cast<std::size_t>(std::ranges::count_if(pixels, has_wall));
}

/// The coarsest drawing that keeps the thin lines which the finest keeps, if that keeps any.
std::optional<Drawing> draw_finer(std::string_view text, const SvgMap& spec,
                                  const std::string& name, const Drawing& coarse) {
  std::optional<Drawing> best;
  std::size_t most = 0;
  for (const int factor : {16, 8, 4, 2}) {
    const std::int64_t columns = std::int64_t{factor} * coarse.walls.width;
    const std::int64_t rows = std::int64_t{factor} * coarse.walls.height;
    if (std::max(columns, rows) > max_image_side || columns * rows > max_image_pixels) continue;
    Drawing finer = draw(text, spec, name, coarse.picture.um_per_px / factor);
    const std::size_t lines = kept(coarse.thin, finer.walls, factor);
    if (lines == 0) break;
    // Where a line crosses pixels aslant, a few of them may fall either way.
    if (static_cast<double>(lines) < 0.98 * static_cast<double>(most)) break;
    most = std::max(most, lines);
    best = std::move(finer);
  }
  return best;
}

std::string lost_ink_note(const Drawing& d, const std::string& name) {
  const double side = d.picture.um_per_px;
  const Vec2 first =
      side * Vec2{d.first.column + 0.5, -d.first.row - 0.5} + Vec2{0, d.picture.height};
  return fmt::format(
      "{}: {} pixels with some ink are free, the first at ({:.6g}, {:.6g}) µm: lines thinner than "
      "a pixel of {:.4g} µm, or pale fills; give {} of about {:.2g} to keep such "
      "lines, map.threshold to keep such fills",
      name, d.lost, first.x, first.y, side, input_name("um_per_px"),
      0.9 * side * d.ink / static_cast<double>(d.lost));
}

}  // namespace

SvgWalls draw_svg_walls(const SvgMap& spec, const std::filesystem::path& file) {
  const std::string name = file.string();
  const std::string text = read_file(file, max_svg_bytes);
  Drawing drawing = draw(text, spec, name, spec.um_per_px);
  std::vector<std::string> notes = std::move(drawing.picture.notes);
  constexpr std::size_t specks = 6;  // fewer are tips and dots, which the note reports
  if (drawing.thin.size() >= specks)
    if (auto finer = draw_finer(text, spec, name, drawing)) {
      notes.push_back(fmt::format(
          "{}: it has lines thinner than a pixel of {:.4g} µm: drawn with pixels of {:.4g} µm",
          name, drawing.picture.um_per_px, finer->picture.um_per_px));
      drawing = *std::move(finer);
    }
  if (drawing.lost > 0) notes.push_back(lost_ink_note(drawing, name));
  return {std::move(drawing.walls),
          drawing.picture.um_per_px,
          {drawing.picture.width, drawing.picture.height},
          std::move(notes)};
}

}  // namespace microswarm::formats
