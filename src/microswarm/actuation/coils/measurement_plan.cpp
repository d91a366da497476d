// SPDX-License-Identifier: Apache-2.0
#include "microswarm/actuation/coils/measurement_plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "microswarm/actuation/amplifiers/amplifiers.hpp"
#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/text/text.hpp"

namespace microswarm::actuation {
namespace {

constexpr double share_of_held = 0.8;
constexpr double unlimited = 1e9;    // [A]
constexpr double same_place = 1e-3;  // [µm]
constexpr double same_plan = 1e-6;   // [A]

/// Rounded down to two significant digits, so that people read it and devices resolve it.
double two_digits(double x) {
  if (x < 1e-6) return 0;
  double per = 1;
  while (x * per < 10) per *= 10;
  while (x * per >= 100) per /= 10;
  return std::floor(x * per * (1 + 1e-12)) / per;
}

/// The largest current of each coil in the plan [A].
Eigen::VectorXd largest_currents(const CoilSystem& system, const std::optional<double>& given) {
  const Amplifiers amplifiers(system.amplifiers());
  const auto n = static_cast<Eigen::Index>(system.size());
  Eigen::VectorXd largest(n);
  for (Eigen::Index k = 0; k < n; ++k) {
    const std::string& name = system.coil_names()[static_cast<std::size_t>(k)];
    const double held = amplifiers.steady(unlimited * Eigen::VectorXd::Unit(n, k)).currents[k];
    if (given && *given > held * (1 + 1e-9))
      throw InputError(
          fmt::format("coil {} can hold {:.4g} A, not {:.6g} A", quote(name), held, *given));
    if (!given && !(held < unlimited))
      throw InputError(
          fmt::format("nothing limits coil {}: its current must be given", quote(name)));
    largest[k] = given ? *given : two_digits(share_of_held * held);
    if (!(largest[k] > 0))
      throw InputError(fmt::format("coil {} can hold no current", quote(name)));
  }
  return largest;
}

}  // namespace

std::vector<MeasurementStep> measurement_plan(const CoilSystem& system,
                                              const MeasurementPlanOptions& options) {
  const Eigen::VectorXd largest = largest_currents(system, options.current);
  const Eigen::Index n = largest.size();
  std::vector<Eigen::VectorXd> currents{Eigen::VectorXd::Zero(n)};
  const auto alone = [&](Eigen::Index k) {
    return Eigen::VectorXd(largest[k] * Eigen::VectorXd::Unit(n, k));
  };
  for (Eigen::Index k = 0; k < n; ++k)
    for (const int sign : {1, -1})
      for (int level = 1; level <= options.levels; ++level)
        currents.emplace_back(sign * level / static_cast<double>(options.levels) * alone(k));
  if (options.pairs)
    for (Eigen::Index k = 0; k + 1 < n; ++k) currents.emplace_back(alone(k) + alone(k + 1));
  std::vector<MeasurementStep> steps;
  for (const Eigen::Vector3d& position : options.positions)
    for (const Eigen::VectorXd& one : currents) steps.push_back({one, position});
  return steps;
}

std::vector<MeasurementStep> missing_steps(const std::vector<MeasurementStep>& steps,
                                           const std::vector<FieldMeasurement>& rows) {
  std::vector<bool> used(rows.size());
  std::vector<MeasurementStep> missing;
  for (const MeasurementStep& step : steps) {
    std::size_t r = 0;
    const auto fits = [&](const FieldMeasurement& row) {
      return row.planned.size() == step.currents.size() &&
             (row.position - step.position).norm() <= same_place &&
             (row.planned - step.currents).cwiseAbs().maxCoeff() <= same_plan;
    };
    while (r < rows.size() && (used[r] || !fits(rows[r]))) ++r;
    if (r < rows.size())
      used[r] = true;
    else
      missing.push_back(step);
  }
  return missing;
}

}  // namespace microswarm::actuation
