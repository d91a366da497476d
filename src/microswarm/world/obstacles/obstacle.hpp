// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "microswarm/core/errors/issue.hpp"
#include "microswarm/world/obstacles/body.hpp"
#include "microswarm/world/obstacles/motion.hpp"

namespace microswarm {

/// Disc centred at the mover's position.
struct DiscShape {
  static constexpr std::string_view type_name = "disc";
  double radius = 50;
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.radius, um("radius", 1e-3, 1e6, "Radius.").needed());
  }
};

/// Disc whose radius varies sinusoidally between its bounds.
struct BreathingDisc {
  static constexpr std::string_view type_name = "breathing_disc";
  double min_radius = 50;
  double max_radius = 100;
  double period = 20;
  double phase = 0;
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.min_radius,
          um("min_radius", 0, 1e6, "Minimum radius.").needed().formerly("least_radius_um"));
    visit(self.max_radius,
          um("max_radius", 0, 1e6, "Maximum radius.").needed().formerly("greatest_radius_um"));
    visit(self.period, s("period", 1e-2, 1e6, "Period."));
    visit(self.phase, plain("phase", -1, 1, "Share of the period at t = 0."));
  }
};

/// Rectangle centred at the mover's position, aligned with its heading.
struct BoxShape {
  static constexpr std::string_view type_name = "box";
  double width = 100;
  double height = 50;
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.width, um("width", 1e-3, 1e6, "Extent along its heading.").needed());
    visit(self.height, um("height", 1e-3, 1e6, "Extent across its heading.").needed());
  }
};

/// Polygon in the mover's frame.
struct PolygonShape {
  static constexpr std::string_view type_name = "polygon";
  std::vector<Vec2> vertices{};
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.vertices, um("vertices", coordinates, "Outline around its position.").needed());
  }
};

/// Two leaves that close a passage from both sides. They lie across the mover's heading and leave a
/// gap that varies sinusoidally between its bounds. A leaf extends from half a span beside the
/// position to the gap: its inner end moves, its outer end is fixed. With a gap of at least the
/// span, the leaves are fully retracted and the passage is clear.
struct Valve {
  static constexpr std::string_view type_name = "valve";
  double span = 400;
  double thickness = 40;
  double min_gap = 0;
  double max_gap = 300;
  double period = 20;
  double phase = 0;
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.span, um("span", 1, 1e6, "Width of the passage.").needed());
    visit(self.thickness, um("thickness", 1e-3, 1e6, "Thickness of the leaves."));
    visit(self.min_gap, um("min_gap", 0, 1e6, "Gap when closed.").formerly("least_gap_um"));
    visit(self.max_gap, um("max_gap", 0, 1e6, "Gap when open.").formerly("greatest_gap_um"));
    visit(self.period, s("period", 1e-2, 1e6, "Period of opening and closing."));
    visit(self.phase, plain("phase", -1, 1, "Share of the period at t = 0."));
  }
};

/// Channel in a solid block with walls that deform over time. The half width is a travelling wave
/// along the centre line, w(s, t) = half width + amplitude · sin(2π(s / wavelength − t / period)).
/// The centre line is a cubic spline through the points. Both ends are round and may be wider. The
/// block's outline is a box. Centre line and block are given in the mover's frame.
struct DeformingChannel {
  static constexpr std::string_view type_name = "deforming_channel";
  std::vector<Vec2> centre_line{};
  double half_width = 200;
  double end_half_width = 200;
  double end_length = 300;
  double amplitude = 30;
  double wavelength = 600;
  double period = 20;
  Vec2 block_centre{};
  double block_width = 2200;
  double block_height = 1600;
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.centre_line,
          um("centre_line", coordinates, "Centre line of the channel; smoothed.").needed());
    visit(self.half_width, um("half_width", 1, 1e6, "Half of the width at rest."));
    visit(self.end_half_width, um("end_half_width", 1, 1e6, "Half of the width at the ends."));
    visit(self.end_length, um("end_length", 0, 1e6, "Length over which an end widens."));
    visit(self.amplitude, um("amplitude", 0, 1e6, "Amplitude of the wave."));
    visit(self.wavelength, um("wavelength", 1, 1e7, "Wavelength along the channel."));
    visit(self.period, s("period", 1e-2, 1e6, "Period of the wave."));
    visit(self.block_centre, um("block_centre", coordinates, "Centre of the solid block."));
    visit(self.block_width, um("block_width", 1, 1e6, "Width of the solid block."));
    visit(self.block_height, um("block_height", 1, 1e6, "Height of the solid block."));
  }
};

using Shape =
    std::variant<DiscShape, BreathingDisc, BoxShape, PolygonShape, Valve, DeformingChannel>;

/// A moving or deforming obstacle.
struct Obstacle {
  Shape shape{};
  Motion motion{};
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.shape, plain("shape", "Shape.").needed());
    visit(self.motion, plain("motion", "Motion.").needed());
  }
};

/// Appends the bodies of obstacle number `index` at time t [s] to `out`: none if it is absent, two
/// for a valve. Pure in t.
void append_bodies(const Obstacle& obstacle, std::uint32_t index, double t, std::vector<Body>& out);

/// Upper bound of the speed of any of its points [µm/s].
double top_speed(const Obstacle& obstacle);

/// Reports inconsistent fields: fewer than three vertices, minimum above maximum radius, a channel
/// that intersects itself, …
Issues validate(const Obstacle& obstacle);

}  // namespace microswarm
