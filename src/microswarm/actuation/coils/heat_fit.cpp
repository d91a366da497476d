// SPDX-License-Identifier: Apache-2.0
#include "microswarm/actuation/coils/heat_fit.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <unsupported/Eigen/NonLinearOptimization>
#include <unsupported/Eigen/NumericalDiff>

#include "microswarm/actuation/amplifiers/coil_heat.hpp"
#include "microswarm/actuation/coils/text_rows.hpp"
#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/maths/infinity.hpp"
#include "microswarm/core/maths/maths.hpp"
#include "microswarm/core/text/csv.hpp"
#include "microswarm/core/text/file.hpp"
#include "microswarm/core/text/text.hpp"

namespace microswarm::actuation {
namespace {

constexpr std::uint64_t max_heat_log_bytes = 16ULL << 20;
constexpr double max_heat_value = 1e9;  // of any number in the file
constexpr double least_share = 0.02;    // of the largest current, below which V/I is noise
constexpr double least_warming = 5;     // [K]
constexpr double least_misfit = 0.5;    // [K] RMS
constexpr double misfit_share = 0.015;  // of the warming
constexpr std::size_t least_readings = 6;
constexpr double largest_error = 0.1;  // relative, of a value that counts as determined

enum HeatColumn { time_column, current_column, voltage_column, temperature_column };
constexpr std::array<std::string_view, 4> heat_columns{"t_s", "i_a", "v_v", "temperature_degc"};

double reference_factor(const AmplifierParams& coil, double temperature) {
  constexpr double reference = 20;  // [°C]
  return 1 + coil.temperature_coefficient * (temperature - reference);
}

/// Least squares problem of a log: parameters are the logarithms of the values.
class HeatResiduals {
 public:
  using Scalar = double;
  using InputType = Eigen::VectorXd;
  using ValueType = Eigen::VectorXd;
  using JacobianType = Eigen::MatrixXd;
  // NOLINTNEXTLINE(readability-identifier-naming): names that Eigen asks for
  enum { InputsAtCompileTime = Eigen::Dynamic, ValuesAtCompileTime = Eigen::Dynamic };

  HeatResiduals(const HeatLog& log, const AmplifierParams& coil) : log_(log), coil_(coil) {
    double most = 0;
    for (const HeatRow& row : log.rows) most = std::max(most, std::abs(row.current));
    least_current_ = least_share * most;
    for (const HeatRow& row : log.rows) {
      if (counts(row)) ++voltages_;
      values_ += (counts(row) ? 1 : 0) + (row.temperature ? 1 : 0);
    }
  }

  int inputs() const { return voltages_ > 0 ? 3 : 2; }
  int values() const { return values_; }
  bool has_voltages() const { return voltages_ > 0; }
  bool counts(const HeatRow& row) const {
    return row.voltage && std::abs(row.current) > least_current_;
  }

  AmplifierParams coil_of(const Eigen::VectorXd& x) const {
    AmplifierParams coil = coil_;
    coil.thermal_resistance = maths::exp(x[0]);
    coil.thermal_time = maths::exp(x[1]);
    if (has_voltages()) coil.resistance = maths::exp(x[2]);
    return coil;
  }

  /// Calls visit(row, temperature) for each row.
  template <class Visit>
  void each_temperature(const AmplifierParams& coil, Visit&& visit) const {
    double temperature = log_.rows.front().temperature.value_or(coil.ambient);
    for (std::size_t k = 0; k < log_.rows.size(); ++k) {
      visit(log_.rows[k], temperature);
      if (k + 1 == log_.rows.size()) break;
      const double current = log_.rows[k].current;
      temperature = temperature_later(coil, temperature, current * current,
                                      log_.rows[k + 1].t - log_.rows[k].t);
    }
  }

  /// Residuals as temperatures [K].
  int operator()(const Eigen::VectorXd& x, Eigen::VectorXd& out) const {
    const AmplifierParams coil = coil_of(x);
    Eigen::Index i = 0;
    each_temperature(coil, [&](const HeatRow& row, double temperature) {
      if (counts(row)) {
        const double expected = coil.resistance * reference_factor(coil, temperature);
        out[i++] = (*row.voltage / row.current / expected - 1) / coil.temperature_coefficient;
      }
      if (row.temperature) out[i++] = *row.temperature - temperature;
    });
    for (Eigen::Index k = 0; k < out.size(); ++k)
      if (!std::isfinite(out[k])) out[k] = max_heat_value;
    return 0;
  }

 private:
  const HeatLog& log_;
  const AmplifierParams& coil_;
  double least_current_ = 0;
  int voltages_ = 0;
  int values_ = 0;
};

using Problem = Eigen::NumericalDiff<HeatResiduals, Eigen::Central>;

struct Solution {
  Eigen::VectorXd x;
  Eigen::VectorXd residuals;
  double sum = infinity;
};

/// Solution from the best of several time constants at the start.
Solution solve(const Problem& problem, const HeatLog& log, double resistance) {
  const double span = log.rows.back().t - log.rows.front().t;
  double power = 0;
  for (const HeatRow& row : log.rows)
    power = std::max(power, row.current * row.current * resistance);
  Solution best;
  for (const double share : {0.05, 0.2, 0.6}) {
    Eigen::VectorXd x(problem.inputs());
    x[0] = maths::log(30 / std::max(power, 1e-9));  // some 30 K
    x[1] = maths::log(share * span);
    if (problem.has_voltages()) x[2] = maths::log(resistance);
    Problem own = problem;
    Eigen::LevenbergMarquardt<Problem> solver(own);
    constexpr int most_evaluations = 2000;
    solver.parameters.maxfev = most_evaluations;
    solver.minimize(x);
    Eigen::VectorXd residuals(problem.values());
    problem(x, residuals);
    if (const double sum = residuals.squaredNorm(); sum < best.sum)
      best = {std::move(x), std::move(residuals), sum};
  }
  return best;
}

/// Standard errors of the parameters, which are logarithms: relative errors of the values.
Eigen::VectorXd standard_errors(const Problem& problem, const Solution& found) {
  Eigen::MatrixXd jacobian(problem.values(), problem.inputs());
  problem.df(found.x, jacobian);
  const double variance = found.sum / (problem.values() - problem.inputs());
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> columns(jacobian);
  columns.setThreshold(1e-6);
  if (columns.rank() < jacobian.cols())  // a value that the readings do not depend on
    return Eigen::VectorXd::Constant(jacobian.cols(), infinity);
  const Eigen::MatrixXd inverse = (jacobian.transpose() * jacobian).inverse();
  return (variance * inverse.diagonal()).cwiseMax(0).cwiseSqrt();
}

double first_resistance(const HeatLog& log, const HeatResiduals& problem) {
  for (const HeatRow& row : log.rows)
    if (problem.counts(row)) return *row.voltage / row.current;
  return 0;
}

void require_signs(const HeatLog& log, const HeatResiduals& problem) {
  for (const HeatRow& row : log.rows)
    if (problem.counts(row) && *row.voltage * row.current <= 0)
      throw InputError(fmt::format("{}:{}: {} V for {} A: they must have the same sign", log.file,
                                   row.line, number_text(*row.voltage), number_text(row.current)));
}

}  // namespace

double temperature_by(double resistance, double cold, const AmplifierParams& coil) {
  const double growth = coil.temperature_coefficient / reference_factor(coil, coil.ambient);
  return coil.ambient + (resistance / cold - 1) / growth;
}

HeatFit fit_heat(const HeatLog& log, const AmplifierParams& coil) {
  const auto fail = [&](const std::string& why) { throw InputError(log.file, why); };
  Problem problem(HeatResiduals(log, coil));
  if (static_cast<std::size_t>(problem.values()) < least_readings)
    fail(fmt::format("{} readings, at least {} are needed", problem.values(), least_readings));
  require_signs(log, problem);
  if (problem.has_voltages() && coil.temperature_coefficient <= 0)
    fail("a voltage shows the temperature by temperature_coefficient_per_k, which is 0");
  const double cold = problem.has_voltages()
                          ? first_resistance(log, problem) / reference_factor(coil, coil.ambient)
                          : coil.resistance;
  const Solution found = solve(problem, log, cold);
  const AmplifierParams fitted = problem.coil_of(found.x);
  const Eigen::VectorXd errors = standard_errors(problem, found);

  HeatFit fit{
      .resistance = {fitted.resistance, 0},
      .thermal_resistance = {fitted.thermal_resistance, errors[0] * fitted.thermal_resistance},
      .thermal_time = {fitted.thermal_time, errors[1] * fitted.thermal_time}};
  if (problem.has_voltages()) fit.resistance.error = errors[2] * fitted.resistance;
  fit.rms = std::sqrt(found.sum / problem.values());
  fit.warmest = -infinity;
  Eigen::Index i = 0;
  problem.each_temperature(fitted, [&](const HeatRow& row, double temperature) {
    fit.warmest = std::max(fit.warmest, temperature);
    for (const bool is_read : {problem.counts(row), row.temperature.has_value()}) {
      if (!is_read) continue;
      const double off = std::abs(found.residuals[i++]);
      if (off > fit.worst) fit.worst = off, fit.worst_line = row.line;
    }
  });
  const double start = log.rows.front().temperature.value_or(coil.ambient);
  const double misfit = least_misfit + misfit_share * std::max(0.0, fit.warmest - start);
  if (fit.rms > misfit)
    fail(
        fmt::format("the readings are {:.2g} K (RMS) off the model of a coil that began at {:.4g} "
                    "°C, allowed {:.2g} K: was it cold, and was each voltage its own?",
                    fit.rms, start, misfit));
  if (const double warmed = fit.warmest - start; warmed < least_warming)
    fail(
        fmt::format("the coil warmed by {:.2g} K, at least {:.2g} K are needed: take a larger "
                    "current or a longer time",
                    warmed, least_warming));
  const double span = log.rows.back().t - log.rows.front().t;
  if (fit.thermal_time.value > 10 * span || fit.thermal_time.value < 1e-3 * span)
    fail(fmt::format("a time constant of {:.2g} s does not follow from readings over {:.4g} s",
                     fit.thermal_time.value, span));
  for (const auto& [name, error] :
       {std::pair{"thermal resistance", errors[0]}, std::pair{"time constant", errors[1]}})
    if (!(error <= largest_error))
      fail(
          fmt::format("the {} is uncertain by {:.2g} %, allowed {:.2g} %: heat and cool for longer",
                      name, 100 * error, 100 * largest_error));
  return fit;
}

HeatLog parse_heat_log(std::string_view text, std::string_view name) {
  TextRows rows(text, name);
  HeatLog log{.file = std::string(name)};
  if (!rows.next()) rows.fail("a header with the columns t_s, i_a, v_v is missing");
  const char separator = csv_separator(rows.row());
  const std::vector<std::string_view> names = csv_cells(rows.row(), separator);
  std::array<std::optional<std::size_t>, 4> at;
  for (std::size_t k = 0; k < heat_columns.size(); ++k)
    if (const auto found = std::ranges::find(names, heat_columns[k]); found != names.end())
      at[k] = static_cast<std::size_t>(found - names.begin());
  for (const HeatColumn needed : {time_column, current_column})
    if (!at[needed]) rows.fail(fmt::format("column '{}' is missing", heat_columns[needed]));
  if (!at[voltage_column] && !at[temperature_column])
    rows.fail("neither column 'v_v' nor 'temperature_degc' is there");
  require_clear_commas(text, name, separator);
  while (rows.next()) {
    const std::vector<std::string_view> cells = csv_cells(rows.row(), separator);
    if (cells.size() != names.size())
      rows.fail(fmt::format("{} fields, the header has {}", cells.size(), names.size()));
    const auto value = [&](HeatColumn column) -> std::optional<double> {
      if (!at[column]) return std::nullopt;
      const std::string_view cell = cells[*at[column]];
      if (cell.empty() && column >= voltage_column) return std::nullopt;
      const double number = rows.number(csv_number(cell, separator), heat_columns[column]);
      if (!(std::abs(number) <= max_heat_value))
        rows.fail(fmt::format("{} is {}, at most {}", heat_columns[column], number_text(number),
                              number_text(max_heat_value)));
      return number;
    };
    const HeatRow row{.t = *value(time_column),
                      .current = *value(current_column),
                      .voltage = value(voltage_column),
                      .temperature = value(temperature_column),
                      .line = rows.line()};
    if (!log.rows.empty() && row.t < log.rows.back().t)
      rows.fail(fmt::format("t_s is {}, earlier than {} before it", number_text(row.t),
                            number_text(log.rows.back().t)));
    log.rows.push_back(row);
  }
  if (log.rows.size() < 2) rows.fail("at least two rows must follow the header");
  return log;
}

HeatLog read_heat_log(const std::filesystem::path& path) {
  return parse_heat_log(read_file(path, max_heat_log_bytes), path.string());
}

std::string to_csv_row(const HeatRow& row) {
  return fmt::format("{},{},{}\n", number_text(row.t), number_text(row.current),
                     row.voltage ? number_text(*row.voltage) : "");
}

}  // namespace microswarm::actuation
