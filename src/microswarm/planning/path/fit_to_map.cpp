// SPDX-License-Identifier: Apache-2.0
#include "microswarm/planning/path/fit_to_map.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <concepts>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/fields/overloaded.hpp"
#include "microswarm/world/connectivity/channel_width.hpp"
#include "microswarm/world/connectivity/corner_lattice.hpp"

namespace microswarm::planning {
namespace {

/// Width [µm] of the channel that the defaults fit: the S-channel of Fig 3 [drrt].
constexpr double usual_width = 280;
constexpr double largest_limit = 10'000'000;  // of nodes or iterations
constexpr double iterations_per_node = 20;    // as the defaults

/// Nodes of a tree that fills the map with steps of this length.
double nodes_for(const Map& map, double step) {
  constexpr double nodes_per_square = 64;
  const Vec2 size = map.bounds().hi - map.bounds().lo;
  return nodes_per_square * (size.x / step) * (size.y / step);
}

/// The lattice through the middle of the passages, if the corners of the map lie on one and the map
/// is not many of its cells.
std::optional<CornerLattice> passage_lattice(const Map& map, double clearance) {
  constexpr double max_cells = 300e3;
  const double least = std::sqrt(map.bounds().width() * map.bounds().height() / max_cells);
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

/// Fits the fields of a planner to the map, within their ranges and unless they are given.
class Fit {
 public:
  Fit(const Map& map, double width, const IsGiven& is_given)
      : map_(map), width_(width), scale_(width / usual_width), is_given_(is_given) {}

  void tolerance(auto& p) const {
    set(p, p.goal_tolerance, std::min(1.0, scale_) * p.goal_tolerance);
  }
  void length(auto& p, double& length) const { set(p, length, scale_ * length); }

  /// Limits of a search whose nodes are this far apart.
  void nodes(auto& p, double step) const { raise(p, p.max_nodes, nodes_for(map_, step)); }
  void nodes(auto& p) const { nodes(p, scale_ * TreeParams{}.step); }

  /// The fields that planners by trees have in common.
  void tree(auto& p) const {
    tolerance(p);
    const double step = is_given_("step_um") ? p.step : scale_ * p.step;
    length(p, p.step);
    nodes(p, step);
    raise(p, p.max_iterations, iterations_per_node * nodes_for(map_, step));
    if (is_given_("sample_pitch_um") || is_given_("sample_origin_um")) return;
    if (const auto lattice = passage_lattice(map_, p.clearance))
      follow(*lattice, map_, p.clearance, p.sample_pitch, p.sample_origin);
  }

  void grid(GridParams& p) const {
    tolerance(p);
    // Some cells across what the swarm may use of a channel.
    constexpr double cells_across = 4;
    set(p, p.cell, std::max(width_ - 2 * p.clearance, width_ / 4) / cells_across);
    nodes(p);
    if (is_given_("cell_um") || is_given_("origin_um")) return;
    if (const auto lattice = passage_lattice(map_, p.clearance)) follow(*lattice, map_, p);
  }

 private:
  /// Calls `change` with the description of a field that is not given.
  template <class Params, class Value, class Change>
  void describe(Params& p, const Value& field, Change&& change) const {
    Params::fields(p, [&]<class Other>(Other& other, const FieldInfo& info) {
      if constexpr (std::same_as<Other, Value>)
        if (&other == &field && !is_given_(key_text(info))) change(info);
    });
  }
  void set(auto& p, double& field, double fitted) const {
    describe(p, field, [&](const FieldInfo& info) {
      field = std::clamp(fitted, info.range.min, info.range.max);
    });
  }
  void raise(auto& p, int& limit, double fitted) const {
    describe(p, limit, [&](const FieldInfo&) {
      limit = std::max(limit, static_cast<int>(std::min(fitted, largest_limit)));
    });
  }

  const Map& map_;
  double width_;
  double scale_;
  const IsGiven& is_given_;
};

}  // namespace

PlannerParams fit_to_map(PlannerParams params, const Map& map, const IsGiven& is_given) {
  Rng rng(1, Purpose::planner);
  double width = 0;
  try {
    width = channel_width(map, rng);
  } catch (const InputError&) {
    return params;
  }
  const Fit fit(map, width, is_given);
  std::visit(Overloaded{[&](ExactParams& p) { fit.tolerance(p); },
                        [&](OneOf<AStarParams, ThetaStarParams> auto& p) { fit.grid(p); },
                        [&](FmtStarParams& p) {
                          fit.tolerance(p);
                          fit.nodes(p);
                        },
                        [&](OneOf<RrtParams, RrtConnectParams> auto& p) { fit.tree(p); },
                        [&](RrtStarParams& p) {
                          fit.tree(p);
                          fit.length(p, p.search_radius);
                        },
                        [&](UniformRrtStarParams& p) {
                          fit.tree(p);
                          fit.length(p, p.search_radius);
                          fit.length(p, p.spacing);
                        },
                        [&](DrrtStarParams& p) {
                          fit.tree(p);
                          for (double* length : {&p.search_radius, &p.detection_diameter, &p.speed,
                                                 &p.smoothness_weight})
                            fit.length(p, *length);
                        }},
             params);
  return params;
}

std::string limit_text(const PlannerParams& params, const PlanCounts& counts) {
  const auto reached = [&](int limit) {
    return counts.iterations >= static_cast<std::uint64_t>(limit);
  };
  const auto nodes = [](const auto& p) {
    return fmt::format("planner.max_nodes is {}", p.max_nodes);
  };
  return std::visit(
      Overloaded{[](const ExactParams&) { return std::string(); },
                 // A grid that is too large is not begun.
                 [&](const OneOf<AStarParams, ThetaStarParams> auto& p) {
                   return reached(p.max_nodes)
                              ? nodes(p)
                              : fmt::format("planner.cell_um is {:.4g}, too small for this map",
                                            p.cell);
                 },
                 [&](const FmtStarParams& p) { return nodes(p); },
                 [&](const OneOf<RrtParams, RrtConnectParams, RrtStarParams, UniformRrtStarParams,
                                 DrrtStarParams> auto& p) {
                   return reached(p.max_iterations)
                              ? fmt::format("planner.max_iterations is {}", p.max_iterations)
                              : nodes(p);
                 }},
      params);
}

}  // namespace microswarm::planning
