// SPDX-License-Identifier: Apache-2.0
#include "microswarm/actuation/coils/winding.hpp"

#include <fmt/format.h>

#include <boost/math/quadrature/gauss.hpp>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/text/text.hpp"

namespace microswarm::actuation {
namespace {

struct Node {
  double at = 0;      ///< in [-1, 1]
  double weight = 1;  ///< the weights sum to 1
};

/// Gauss–Legendre nodes that replace closely wound turns; a single node at the middle if the
/// winding is not extended.
template <unsigned points>
std::vector<Node> nodes(bool extended) {
  if (!extended) return {Node{}};
  using Rule = boost::math::quadrature::gauss<double, points>;
  std::vector<Node> all;
  for (std::size_t i = 0; i < Rule::abscissa().size(); ++i) {
    const double x = Rule::abscissa()[i];
    const double w = 0.5 * Rule::weights()[i];
    all.push_back({x, w});
    if (x > 0) all.push_back({-x, w});
  }
  return all;
}

}  // namespace

Eigen::Vector3d to_vector(const std::vector<double>& numbers, std::string_view key,
                          Issues& issues) {
  if (numbers.size() == 3) return {numbers[0], numbers[1], numbers[2]};
  issues.add(key, fmt::format("{} has {} numbers, must be [x, y, z]", key, numbers.size()));
  return Eigen::Vector3d::Zero();
}

std::vector<CurrentLoop> to_loops(const WindingParams& winding, Issues& issues) {
  const std::size_t before = issues.size();
  const Eigen::Vector3d centre = to_vector(winding.centre, "centre_um", issues);
  const Eigen::Vector3d axis = to_vector(winding.axis, "axis", issues);
  if (winding.axis.size() == 3 && !(axis.norm() > 0))
    issues.add("axis", "axis is [0, 0, 0], must have a direction");
  if (winding.thickness >= 2 * winding.radius)
    issues.add("thickness_um",
               fmt::format("thickness_um is {} µm, must be less than twice the radius, {} µm",
                           number_text(winding.thickness), number_text(2 * winding.radius)));
  if (issues.size() > before) return {};
  const Eigen::Vector3d unit = axis.normalized();
  std::vector<CurrentLoop> loops;
  for (const Node& along : nodes<20>(winding.length > 0))
    for (const Node& out : nodes<10>(winding.thickness > 0))
      loops.push_back({centre + 0.5 * winding.length * along.at * unit, unit,
                       winding.radius + 0.5 * winding.thickness * out.at,
                       winding.turns * along.weight * out.weight});
  return loops;
}

FieldGradient field_at(const std::vector<CurrentLoop>& loops, const Eigen::Vector3d& position) {
  FieldGradient sum;
  for (const CurrentLoop& loop : loops) sum += loop_field(loop, position);
  return sum;
}

}  // namespace microswarm::actuation
