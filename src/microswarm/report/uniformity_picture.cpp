// SPDX-License-Identifier: Apache-2.0
#include "microswarm/report/uniformity_picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "microswarm/io/columns.hpp"
#include "microswarm/report/picture.hpp"

namespace microswarm::report {
namespace {

/// Bands of increasing deviation.
struct DeviationBand {
  double max_deviation;
  const char* label;
  Colour colour;
};
constexpr std::array<DeviationBand, 6> deviation_bands{{{0.001, "to 0.1 %", {0.99, 0.96, 0.80, 1}},
                                                        {0.01, "to 1 %", {0.78, 0.89, 0.70, 1}},
                                                        {0.02, "to 2 %", {0.47, 0.78, 0.72, 1}},
                                                        {0.05, "to 5 %", {0.25, 0.60, 0.72, 1}},
                                                        {0.10, "to 10 %", {0.20, 0.40, 0.65, 1}},
                                                        {1e300, "more", {0.17, 0.20, 0.42, 1}}}};

const DeviationBand& deviation_band(double of) {
  return *std::find_if(deviation_bands.begin(), deviation_bands.end() - 1,
                       [&](const DeviationBand& band) { return of <= band.max_deviation; });
}

/// One pixel per point, the highest row on top.
formats::Image to_image(const actuation::UniformityMap& map) {
  const int n = map.grid.points;
  formats::Image image{n, n, 3, std::vector<std::uint8_t>(static_cast<std::size_t>(n) * n * 3)};
  for (int row = 0; row < n; ++row)
    for (int column = 0; column < n; ++column) {
      const Colour c = deviation_band(map.at(column, row)).colour;
      std::uint8_t* pixel = &image.pixels[image.index(column, n - 1 - row)];
      for (const double part : {c.red, c.green, c.blue})
        *pixel++ = static_cast<std::uint8_t>(std::lround(255 * part));
    }
  return image;
}

/// A point of the grid as in the table.
struct FieldRow {
  std::array<double, 3> position{};
  std::array<double, 3> field{};
  double deviation = 0;
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.position[0], um("x", "Place among the coils."));
    visit(self.position[1], um("y", "Place among the coils."));
    visit(self.position[2], um("z", "Place among the coils."));
    visit(self.field[0], mt("bx", "Field."));
    visit(self.field[1], mt("by", "Field."));
    visit(self.field[2], mt("bz", "Field."));
    visit(self.deviation, plain("deviation", "From the field at the centre."));
  }
};

/// Title: axes, with `centre` the centre, and the field there.
std::string default_title(const actuation::UniformityMap& map, bool centre) {
  const std::string_view plane = enum_name(map.grid.plane);
  const Eigen::Vector3d& c = map.grid.centre;
  const Eigen::Vector3d& b = map.centre_field;
  return fmt::format("|B − B0| / |B0|, {} to the right, {} up{}, B0 = ({:.3g}, {:.3g}, {:.3g}) mT",
                     plane[0], plane[1],
                     centre ? fmt::format(", around ({:g}, {:g}, {:g}) µm", c[0], c[1], c[2]) : "",
                     b[0], b[1], b[2]);
}

}  // namespace

void draw_uniformity(const actuation::UniformityMap& map, bool centre,
                     const std::filesystem::path& file) {
  // Each point is the centre of its pixel.
  const double step = 2 * map.grid.half_width / (map.grid.points - 1);
  const double side = step * map.grid.points;
  Picture picture(Box{{0, 0}, {side, side}}, default_title(map, centre), 800);
  picture.photo(to_image(map), step);
  picture.mark({0.5 * side, 0.5 * side}, "B0");
  for (const DeviationBand& band : deviation_bands) picture.legend(band.label, band.colour);
  picture.write(file);
}

std::string uniformity_table(const actuation::UniformityMap& map) {
  std::vector<FieldRow> rows;
  for (int row = 0; row < map.grid.points; ++row)
    for (int column = 0; column < map.grid.points; ++column) {
      const auto i = static_cast<std::size_t>(row) * map.grid.points + column;
      const Eigen::Vector3d p = map.place(column, row);
      const Eigen::Vector3d& b = map.field[i];
      rows.push_back({{p[0], p[1], p[2]}, {b[0], b[1], b[2]}, map.deviation[i]});
    }
  return io::csv_table(rows);
}

}  // namespace microswarm::report
