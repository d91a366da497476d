// SPDX-License-Identifier: Apache-2.0
#include "microswarm/planning/path/fit_to_map.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "microswarm/world/connectivity/channel_width.hpp"
#include "microswarm/world/connectivity/corner_lattice.hpp"

namespace microswarm {
namespace {

/// Width [µm] of the channel that the defaults fit: the S-channel of Fig 3 [drrt].
constexpr double usual_width = 280;
constexpr double largest_limit = 10'000'000;  // of nodes or iterations
constexpr double iterations_per_node = 20;    // as the defaults

constexpr std::array<std::string_view, 6> lengths{
    "step", "search_radius", "spacing", "detection_diameter", "speed", "smoothness_weight"};

/// Nodes of a tree that fills the map with steps of this length.
double nodes_for(const Map& map, double step) {
  constexpr double nodes_per_square = 64;
  const Vec2 size = map.bounds().hi - map.bounds().lo;
  return nodes_per_square * (size.x / step) * (size.y / step);
}

template <class Params>
double step_of(const Params& params, double scale, const IsGiven& is_given) {
  if constexpr (requires { params.step; })
    return is_given("step_um") ? params.step : scale * params.step;
  return scale * TreeParams{}.step;
}

/// The lattice through the middle of the passages, if the corners of the map lie on one and the map
/// is not many of its cells.
std::optional<CornerLattice> passage_lattice(const Map& map, double clearance) {
  constexpr double most_cells = 300e3;
  const double least = std::sqrt(map.bounds().width() * map.bounds().height() / most_cells);
  const auto corners = corner_lattice(map, least);
  if (!corners) return std::nullopt;
  return through_narrowest_passage(*corners, clearance);
}

/// Cells no larger than the narrowest passage, and places in the middle of all. Half as large as
/// without a lattice, for shorter paths: since the passages are found, this costs little.
void follow(const CornerLattice& lattice, const Map& map, GridParams& grid) {
  const int pitches = static_cast<int>(std::max(1.0, 0.5 * grid.cell / lattice.pitch));
  const double parts = std::max(1.0, std::round(lattice.pitch / grid.cell));
  grid.origin = lattice.origin;
  grid.cell = lattice.pitch * shortest_free_run(map, lattice, grid.clearance, pitches) / parts;
}

/// Samples on the lattice, if there are passages with a single row of its points.
void follow(const CornerLattice& lattice, const Map& map, double clearance, double& sample_pitch,
            Vec2& sample_origin) {
  if (shortest_free_run(map, lattice, clearance, 2) > 1) return;
  sample_pitch = lattice.pitch;
  sample_origin = lattice.origin;
}

/// Fits what follows from the lattice of the map's corners, unless a part of it is given.
template <class Params>
void fit_to_lattice(Params& params, const Map& map, const IsGiven& is_given) {
  constexpr bool is_grid = std::is_base_of_v<GridParams, Params>;
  if constexpr (is_grid || requires { params.sample_pitch; }) {
    const std::array<std::string_view, 2> keys{is_grid ? "cell_um" : "sample_pitch_um",
                                               is_grid ? "origin_um" : "sample_origin_um"};
    if (std::ranges::any_of(keys, is_given)) return;
    const auto lattice = passage_lattice(map, params.clearance);
    if (!lattice) return;
    if constexpr (is_grid)
      follow(*lattice, map, params);
    else
      follow(*lattice, map, params.clearance, params.sample_pitch, params.sample_origin);
  }
}

template <class Params>
void fit(Params& params, const Map& map, double width, const IsGiven& is_given) {
  const double scale = width / usual_width;
  const double nodes = nodes_for(map, step_of(params, scale, is_given));
  // Some cells across what the swarm may use of a channel.
  constexpr double cells_across = 4;
  const double cell = std::max(width - 2 * params.clearance, width / 4) / cells_across;
  Params::fields(params, [&](auto& value, const FieldInfo& info) {
    if (is_given(key_of(info))) return;
    const auto in_range = [&](double fitted) {
      return std::clamp(fitted, info.range.min, info.range.max);
    };
    if constexpr (std::is_same_v<decltype(value), double&>) {
      if (std::ranges::count(lengths, info.name) > 0) value = in_range(scale * value);
      if (info.name == "goal_tolerance") value = in_range(std::min(1.0, scale) * value);
      if (info.name == "cell") value = in_range(cell);
    }
    if constexpr (std::is_same_v<decltype(value), int&>) {
      const auto at_least = [&](double fitted) {
        value = std::max(value, static_cast<int>(std::min(fitted, largest_limit)));
      };
      if (info.name == "max_nodes") at_least(nodes);
      if (info.name == "max_iterations") at_least(iterations_per_node * nodes);
    }
  });
  fit_to_lattice(params, map, is_given);
}

}  // namespace

PlannerParams fit_to_map(PlannerParams params, const Map& map, const IsGiven& is_given) {
  Rng rng(1, Purpose::planner);
  double width = 0;
  try {
    width = channel_width(map, rng);
  } catch (const InputError&) {
    return params;
  }
  std::visit([&](auto& chosen) { fit(chosen, map, width, is_given); }, params);
  return params;
}

std::string limit_text(const PlannerParams& params, const PlanCounts& counts) {
  std::string text;
  const auto reached = [&](int limit) {
    return counts.iterations >= static_cast<std::uint64_t>(limit);
  };
  std::visit(
      [&]<class Params>(const Params& chosen) {
        Params::fields(chosen, [&](const auto& value, const FieldInfo& info) {
          if constexpr (std::is_same_v<decltype(value), const int&>)
            if (info.name == "max_nodes" || (info.name == "max_iterations" && reached(value)))
              text = fmt::format("planner.{} is {}", key_of(info), value);
        });
        // A grid that is too large is not begun.
        if constexpr (std::is_base_of_v<GridParams, Params>)
          if (!reached(chosen.max_nodes))
            text = fmt::format("planner.cell_um is {:.4g}, too small for this map", chosen.cell);
      },
      params);
  return text;
}

}  // namespace microswarm
