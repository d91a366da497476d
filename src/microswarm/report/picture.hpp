// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "microswarm/contracts/plan.hpp"
#include "microswarm/formats/images/image.hpp"
#include "microswarm/report/colours.hpp"
#include "microswarm/world/snapshot.hpp"

namespace microswarm::report {

/// A drawing of a world in its own coordinates [µm, y up], written as PNG, SVG or PDF according to
/// the file's extension. Later drawings are on top. Line widths and text sizes are in pixels of the
/// finished picture. Discs are drawn with a radius of at least 4 pixels.
class Picture {
 public:
  /// Shows `view`. The longer side of the drawing is `pixels` long; a margin around it holds the
  /// title, the scale bar and the legend.
  explicit Picture(const Box& view, std::string_view title = {}, double pixels = 1200);
  ~Picture();
  Picture(const Picture&) = delete;
  Picture& operator=(const Picture&) = delete;

  /// Length that one pixel of the finished picture shows [µm].
  double um_per_px() const;

  /// Draws a photograph as background, `um_per_px` µm per pixel, its lower left corner at the
  /// origin; `fade` in [0, 1] whitens it.
  void photo(const formats::Image& image, double um_per_px, double fade = 0);
  /// Draws another picture of the same view and size as pixels, which are cached in it.
  void ground(const Picture& other);
  void walls(const Map& map, Colour fill = colours::wall, Colour edge = colours::wall_edge);
  void bodies(std::span<const Body> bodies, Colour fill = colours::obstacle);
  void tree(std::span<const TreeNode> tree, Colour colour = colours::tree);
  void line(std::span<const Vec2> points, Colour colour = colours::path, double width_px = 2.5,
            bool dashed = false);
  void disc(Disc disc, Colour fill);
  void circle(Disc disc, Colour colour, double width_px = 1.5, bool dashed = true);
  /// Draws the swarm's body with a tick at its heading.
  void swarm(const Pose2& pose, double radius, Colour colour = colours::swarm);
  /// Draws a labelled point: a ring of constant size.
  void mark(Vec2 at, std::string_view label, Colour colour = colours::ink);
  void text(Vec2 at, std::string_view text, Colour colour = colours::ink, double size_px = 15);
  /// Adds an entry to the legend, which has as many lines as needed.
  void legend(std::string_view label, Colour colour, bool round = false);

  /// The finished picture as pixels, its sides rounded up to even numbers, as videos need.
  formats::Image raster() const;
  /// The finished picture as the bytes of a PNG file.
  std::string png() const;
  /// Writes the finished picture; throws InputError unless the extension is .png, .svg or .pdf. Can
  /// be called repeatedly.
  void write(const std::filesystem::path& path) const;
  /// Writes stem.png, stem.svg and stem.pdf.
  void write_everywhere(const std::filesystem::path& stem) const;

 private:
  friend void write_sheet(std::span<const std::unique_ptr<Picture>>, int,
                          const std::filesystem::path&);
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Writes pictures as one sheet, row by row with at most `columns` columns; .png, .svg or .pdf as
/// above. Does nothing without pictures.
void write_sheet(std::span<const std::unique_ptr<Picture>> pictures, int columns,
                 const std::filesystem::path& path);

}  // namespace microswarm::report
