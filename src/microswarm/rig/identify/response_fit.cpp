// SPDX-License-Identifier: Apache-2.0
#include "microswarm/rig/identify/response_fit.hpp"

#include <fmt/core.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <complex>
#include <span>

#include "microswarm/core/maths/angles.hpp"
#include "microswarm/core/maths/maths.hpp"
#include "microswarm/rig/identify/driven_path.hpp"

namespace microswarm::rig {
namespace {

using Complex = std::complex<double>;

constexpr std::size_t min_sightings = 20;
constexpr double min_delay = -0.1, max_delay = 1.5, coarse = 0.02;  // [s]

Complex to_complex(Vec2 v) { return {v.x, v.y}; }

bool is_usual(const ResponseData& data, const DrivenCommand& command) {
  return std::abs(command.frequency - data.field.frequency) < 1e-3 * data.field.frequency;
}

/// Half-open range of indices.
struct Section {
  std::size_t begin = 0, end = 0;
};

/// The section of usual frequency in which most commands move the swarm.
Section longest_section(const ResponseData& data) {
  Section best, now;
  double longest = 0, moving = 0;
  for (std::size_t i = 0; i < data.commands.size(); ++i) {
    if (!is_usual(data, data.commands[i])) {
      now = {i + 1, i + 1};
      moving = 0;
      continue;
    }
    now.end = i + 1;
    if (i + 1 < data.commands.size() && data.commands[i].command.speed > 0)
      moving += data.commands[i + 1].t - data.commands[i].t;
    if (moving > longest) longest = moving, best = now;
  }
  return best;
}

/// Solution at one delay.
struct LinearFit {
  Eigen::Vector3cd values = Eigen::Vector3cd::Zero();  // place, drift, gain with angle
  Eigen::VectorXcd residuals{};
  double squares = 0;
};

class Problem {
 public:
  Problem(const DrivenPath& path, std::span<const Sighting> seen) : path_(path), seen_(seen) {
    for (const Sighting& s : seen) middle_ += s.t / static_cast<double>(seen.size());
  }
  Eigen::MatrixXcd columns(double delay) const {
    Eigen::MatrixXcd columns(rows(), 3);
    for (Eigen::Index i = 0; i < rows(); ++i) {
      const double t = seen_[static_cast<std::size_t>(i)].t;
      columns.row(i) << 1, t - middle_, to_complex(path_.at(t - delay));
    }
    return columns;
  }
  Eigen::VectorXcd places() const {
    Eigen::VectorXcd z(rows());
    for (Eigen::Index i = 0; i < rows(); ++i)
      z[i] = to_complex(seen_[static_cast<std::size_t>(i)].position);
    return z;
  }
  LinearFit solve(double delay) const {
    const Eigen::MatrixXcd x = columns(delay);
    const Eigen::VectorXcd z = places();
    LinearFit fit;
    fit.values = x.colPivHouseholderQr().solve(z);
    fit.residuals = z - x * fit.values;
    fit.squares = fit.residuals.squaredNorm();
    return fit;
  }
  Eigen::Index rows() const { return static_cast<Eigen::Index>(seen_.size()); }

 private:
  const DrivenPath& path_;
  std::span<const Sighting> seen_;
  double middle_ = 0;  // of the times [s]
};

/// Delay with the least sum of squares: by a grid, then by golden section.
double best_delay(const Problem& problem) {
  double best = 0, least = -1;
  for (double d = min_delay; d <= max_delay; d += coarse)
    if (const double squares = problem.solve(d).squares; least < 0 || squares < least)
      least = squares, best = d;
  constexpr double golden = 0.6180339887498949;
  double low = best - coarse, high = best + coarse;
  for (int i = 0; i < 25; ++i) {
    const double a = high - golden * (high - low), b = low + golden * (high - low);
    (problem.solve(a).squares < problem.solve(b).squares ? high : low) =
        problem.solve(a).squares < problem.solve(b).squares ? b : a;
  }
  return (low + high) / 2;
}

/// Factor of the standard errors by residuals that resemble the one before.
double inflation(const Eigen::VectorXcd& residuals) {
  double product = 0;
  for (Eigen::Index i = 1; i < residuals.size(); ++i)
    product += (residuals[i] * std::conj(residuals[i - 1])).real();
  const double share = std::clamp(product / residuals.squaredNorm(), 0.0, 0.98);
  return std::sqrt((1 + share) / (1 - share));
}

/// Covariance of gain · (cos, sin) and delay, the last three of seven parameters.
Eigen::Matrix3d covariance(const Problem& problem, double delay, const LinearFit& fit) {
  constexpr double h = 0.01;  // [s]
  const Eigen::Index n = problem.rows();
  const Eigen::MatrixXcd x = problem.columns(delay);
  const Eigen::VectorXcd slope =
      (problem.columns(delay + h).col(2) - problem.columns(delay - h).col(2)) / (2 * h) *
      fit.values[2];
  Eigen::MatrixXd jacobian(2 * n, 7);
  for (Eigen::Index k = 0; k < 3; ++k) {
    jacobian.col(2 * k) << x.col(k).real(), x.col(k).imag();
    jacobian.col(2 * k + 1) << -x.col(k).imag(), x.col(k).real();
  }
  jacobian.col(6) << slope.real(), slope.imag();
  const double variance = fit.squares / static_cast<double>(2 * n - 7);
  const double factor = inflation(fit.residuals);
  const Eigen::MatrixXd all =
      (jacobian.transpose() * jacobian).ldlt().solve(Eigen::MatrixXd::Identity(7, 7));
  return factor * factor * variance * all.bottomRightCorner(3, 3);
}

double variance_of(const Problem& problem) {
  const Eigen::VectorXcd z = problem.places();
  return (z.array() - z.mean()).matrix().squaredNorm();
}

std::vector<Sighting> between(const std::vector<Sighting>& seen, double from, double until) {
  std::vector<Sighting> some;
  std::ranges::copy_if(seen, std::back_inserter(some),
                       [&](const Sighting& s) { return s.t >= from && s.t <= until; });
  return some;
}

double level_frequency(const actuation::FieldGeneratorParams& field, const DrivenCommand& command) {
  return field.kind == actuation::FieldKind::rolling ? command.command.speed / field.length_per_turn
                                                     : command.frequency;
}

/// Share of the driven distance that was moved between two times.
std::optional<Estimate> fit_share(const DrivenPath& path, const std::vector<Sighting>& seen,
                                  double from, double until, const ResponseFit& usual) {
  const std::vector<Sighting> some = between(seen, from, until);
  const auto n = static_cast<Eigen::Index>(some.size());
  if (n < 5) return std::nullopt;
  Eigen::MatrixXcd x(n, 2);
  Eigen::VectorXcd z(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const Sighting& s = some[static_cast<std::size_t>(i)];
    x.row(i) << 1, to_complex(path.at(s.t - usual.delay.value));
    z[i] = to_complex(s.position - s.t * usual.drift);
  }
  const Eigen::VectorXcd fitted = x.colPivHouseholderQr().solve(z);
  const Complex share = fitted[1] * to_complex(unit_vector(-usual.angle.value));
  const Eigen::VectorXcd off = x.col(1).array() - x.col(1).mean();
  if (off.squaredNorm() < 1e-12) return std::nullopt;
  const Eigen::VectorXcd residuals = z - x * fitted;
  const double variance = residuals.squaredNorm() / static_cast<double>(2 * n - 4);
  return Estimate{share.real(), inflation(residuals) * std::sqrt(variance / off.squaredNorm())};
}

/// The largest level up to which all are followed, and the first that is not.
void bracket(StepOut& found) {
  std::ranges::sort(found.levels, {}, &FrequencyLevel::frequency);
  double best = 0;
  for (const FrequencyLevel& level : found.levels) {
    best = std::max(best, level.share.value);
    if (level.share.value < followed_share * best) {
      found.lost = level.frequency;
      return;
    }
    found.followed = level.frequency;
  }
}

}  // namespace

std::optional<ResponseFit> fit_response(const ResponseData& data) {
  const Section section = longest_section(data);
  if (section.end <= section.begin) return std::nullopt;
  const std::span<const DrivenCommand> commands =
      std::span(data.commands).subspan(section.begin, section.end - section.begin);
  const bool is_last = section.end == data.commands.size();
  const double from = commands.front().t;
  const double until = is_last ? commands.back().t + max_delay : data.commands[section.end].t;
  const std::vector<Sighting> seen = between(data.seen, from, until);
  const DrivenPath path(data.field, commands, max_delay);
  if (seen.size() < min_sightings || path.length() <= 0) return std::nullopt;
  const Problem problem(path, seen);
  const double delay = best_delay(problem);
  const LinearFit fit = problem.solve(delay);
  const Complex response = fit.values[2];
  const double gain = std::abs(response);
  const Eigen::Matrix3d spread = covariance(problem, delay, fit);
  const Eigen::Vector2d along(response.real() / gain, response.imag() / gain);
  const Eigen::Vector2d left(-along[1], along[0]);
  const Eigen::Matrix2d of_gain = spread.topLeftCorner(2, 2);
  ResponseFit result{.gain = {gain, std::sqrt(along.dot(of_gain * along))},
                     .angle = {maths::atan2(response.imag(), response.real()),
                               std::sqrt(left.dot(of_gain * left)) / gain},
                     .delay = {delay, std::sqrt(spread(2, 2))},
                     .drift = {fit.values[1].real(), fit.values[1].imag()},
                     .residual = std::sqrt(fit.squares / static_cast<double>(seen.size())),
                     .explained = 1 - fit.squares / variance_of(problem),
                     .driven = path.length(),
                     .from = from,
                     .until = until,
                     .sightings = seen.size()};
  const Eigen::VectorXcd fitted = problem.places() - fit.residuals;
  for (std::size_t i = 0; i < seen.size(); ++i) {
    const Complex z = fitted[static_cast<Eigen::Index>(i)];
    result.path.push_back({seen[i].t, {z.real(), z.imag()}});
  }
  return result;
}

std::vector<std::string> doubts(const ResponseFit& fit) {
  constexpr double max_gain_error = 0.1;  // of the gain
  const double max_angle_error = radians(5);
  constexpr double max_delay_error = 0.1;  // [s]
  constexpr double min_gain = 0.1, min_explained = 0.9;
  std::vector<std::string> out;
  if (!(fit.gain.value >= min_gain))
    out.push_back(
        fmt::format("the swarm moved {:.0f} % of its commanded distance: it does not follow",
                    100 * fit.gain.value));
  if (!(fit.explained >= min_explained))
    out.push_back(
        fmt::format("the commands explain {:.0f} % of the motion that was seen, {:.0f} % are "
                    "needed",
                    100 * fit.explained, 100 * min_explained));
  if (!(fit.gain.error <= max_gain_error * fit.gain.value))
    out.push_back(
        fmt::format("the gain is uncertain by {:.0f} %, at most {:.0f} % are allowed: drive "
                    "further",
                    100 * fit.gain.error / fit.gain.value, 100 * max_gain_error));
  if (!(fit.angle.error <= max_angle_error))
    out.push_back(
        fmt::format("the angle is uncertain by {:.1f}°, at most {:.0f}° are allowed: drive "
                    "further",
                    degrees(fit.angle.error), degrees(max_angle_error)));
  if (!(fit.delay.error <= max_delay_error))
    out.push_back(
        fmt::format("the delay is uncertain by {:.0f} ms, at most {:.0f} ms are allowed: "
                    "drive more turns",
                    1e3 * fit.delay.error, 1e3 * max_delay_error));
  if (fit.delay.value > max_delay - coarse || fit.delay.value < min_delay + coarse)
    out.push_back(
        fmt::format("the delay is outside {:.0f} to {:.0f} ms", 1e3 * min_delay, 1e3 * max_delay));
  return out;
}

StepOut fit_step_out(const ResponseData& data, const ResponseFit& fit) {
  constexpr double min_time = 0.5;  // [s]
  StepOut found;
  const auto begin = std::ranges::find_if(data.commands, [&](const DrivenCommand& command) {
    return command.t >= fit.until && !is_usual(data, command);
  });
  const std::span<const DrivenCommand> commands(begin, data.commands.end());
  if (commands.empty()) return found;
  const auto driven = std::ranges::find_if(
      data.commands, [&](const DrivenCommand& command) { return command.t >= fit.from; });
  const DrivenPath path(data.field, {driven, data.commands.end()}, max_delay);
  for (std::size_t i = 0; i < commands.size();) {
    const double frequency = level_frequency(data.field, commands[i]);
    std::size_t end = i;
    while (end < commands.size() &&
           (end == i ||
            std::abs(level_frequency(data.field, commands[end]) - frequency) < 5e-3 * frequency))
      ++end;
    const double from = commands[i].t + fit.delay.value;
    const double until = commands[std::min(end, commands.size() - 1)].t + fit.delay.value;
    i = end;
    if (frequency <= 0 || until - from < min_time) continue;
    if (const auto share = fit_share(path, data.seen, from, until, fit))
      found.levels.push_back({frequency, *share});
  }
  bracket(found);
  return found;
}

}  // namespace microswarm::rig
