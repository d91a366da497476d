// SPDX-License-Identifier: Apache-2.0
#include "microswarm/actuation/coils/field_comparison.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "microswarm/core/maths/angles.hpp"
#include "microswarm/core/maths/maths.hpp"

namespace microswarm::actuation {
namespace {

constexpr double weakest = 0.7, strongest = 1.4;
constexpr double most_turned = radians(15);

/// A factor between fields that has a usual cause.
struct UsualFactor {
  double factor;
  const char* cause;
};
constexpr std::array<UsualFactor, 6> usual_factors{
    {{2, "full_scale_a or the turns wrong by 2?"},
     {0.5, "full_scale_a or the turns wrong by 2?"},
     {10, "gauss instead of mT?"},
     {0.1, "a decimal point, or a range of the probe?"},
     {1000, "µT instead of mT?"},
     {0.001, "T instead of mT?"}}};

bool is_usual(double ratio) { return ratio >= weakest && ratio <= strongest; }

double angle_between(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return maths::atan2(a.cross(b).norm(), a.dot(b));
}

/// Axes of a probe whose exchange explains the direction: "x and y"; empty if none does.
std::string exchanged_axes(const Eigen::Vector3d& measured, const Eigen::Vector3d& expected) {
  for (int i = 0; i < 3; ++i)
    for (int k = i + 1; k < 3; ++k) {
      Eigen::Vector3d exchanged = measured;
      std::swap(exchanged[i], exchanged[k]);
      if (angle_between(exchanged, expected) <= most_turned)
        return fmt::format("{} and {}", "xyz"[i], "xyz"[k]);
    }
  return {};
}

}  // namespace

bool FieldComparison::is_plausible() const { return is_usual(ratio) && angle <= most_turned; }

FieldComparison compare_fields(const Eigen::Vector3d& measured, const Eigen::Vector3d& expected) {
  return {measured.norm() / expected.norm(), angle_between(measured, expected)};
}

std::string field_doubt(const Eigen::Vector3d& measured, const Eigen::Vector3d& expected) {
  const FieldComparison found = compare_fields(measured, expected);
  if (found.is_plausible()) return {};
  std::string doubt;
  if (!is_usual(found.ratio)) {
    doubt = fmt::format("{:.3g} times the expected field", found.ratio);
    for (const UsualFactor& usual : usual_factors)
      if (is_usual(found.ratio / usual.factor)) doubt += fmt::format(": {}", usual.cause);
  }
  // Of a field without strength no direction is known.
  constexpr double directed = 1e-4;
  if (found.angle <= most_turned || found.ratio < directed) return doubt;
  if (!doubt.empty()) doubt += "; ";
  doubt += fmt::format("{:.3g}° from the expected direction", degrees(found.angle));
  if (found.angle >= pi - most_turned)
    doubt += ": a reversed coil or probe?";
  else if (const std::string axes = exchanged_axes(measured, expected); !axes.empty())
    doubt += fmt::format(": {} of the probe exchanged?", axes);
  return doubt;
}

}  // namespace microswarm::actuation
