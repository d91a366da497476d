// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "microswarm/contracts/plan.hpp"
#include "microswarm/formats/images/image.hpp"
#include "microswarm/world/snapshot.hpp"

namespace microswarm::report {

/// Colour with components in [0, 1].
struct Colour {
  double red = 0;
  double green = 0;
  double blue = 0;
  double alpha = 1;
};

/// Colours of all pictures: one meaning each, safe for colour-blind readers (after Okabe & Ito).
namespace colours {
inline constexpr Colour paper{1, 1, 1, 1};
inline constexpr Colour ink{0.13, 0.15, 0.18, 1};
inline constexpr Colour wall{0.80, 0.82, 0.85, 1};
inline constexpr Colour wall_edge{0.45, 0.48, 0.53, 1};
inline constexpr Colour obstacle{0.84, 0.37, 0.0, 0.85};
inline constexpr Colour path{0.0, 0.45, 0.70, 1};
inline constexpr Colour tree{0.55, 0.70, 0.85, 0.9};
inline constexpr Colour circle{0.80, 0.47, 0.65, 0.9};
inline constexpr Colour swarm{0.0, 0.62, 0.45, 1};
inline constexpr Colour goal{0.40, 0.25, 0.65, 1};
/// Colours of individually tracked robots, in order.
inline constexpr std::array<Colour, 8> robots{{{0.0, 0.45, 0.70, 1},
                                               {0.84, 0.37, 0.0, 1},
                                               {0.0, 0.62, 0.45, 1},
                                               {0.80, 0.47, 0.65, 1},
                                               {0.90, 0.62, 0.0, 1},
                                               {0.34, 0.71, 0.91, 1},
                                               {0.40, 0.30, 0.65, 1},
                                               {0.35, 0.35, 0.35, 1}}};
}  // namespace colours

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
