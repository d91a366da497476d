// SPDX-License-Identifier: Apache-2.0
#include "microswarm/actuation/coils/coil_system.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "microswarm/config/yaml.hpp"
#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/fields/overloaded.hpp"
#include "microswarm/core/text/input_folder.hpp"
#include "microswarm/core/text/text.hpp"

namespace microswarm::actuation {
namespace {

constexpr std::array<const char*, 3> axis_names{"x", "y", "z"};
constexpr std::size_t max_coils_of_set = 64;

WindingParams winding(const Eigen::Vector3d& centre, int axis, double radius, double turns,
                      double length, double thickness) {
  WindingParams w;
  w.centre = {centre[0], centre[1], centre[2]};
  w.axis = {0, 0, 0};
  w.axis[static_cast<std::size_t>(axis)] = 1;
  w.radius = radius;
  w.turns = turns;
  w.length = length;
  w.thickness = thickness;
  return w;
}

void append(std::vector<CurrentLoop>& loops, const std::vector<CurrentLoop>& more) {
  loops.insert(loops.end(), more.begin(), more.end());
}

std::string place_text(const Eigen::Vector3d& v) {
  return fmt::format("({}, {}, {}) µm", number_text(v[0]), number_text(v[1]), number_text(v[2]));
}

}  // namespace

CoilSystem::CoilSystem(const CoilSystemParams& params, const KeyLocations& keys,
                       const std::filesystem::path& folder)
    : folder_(folder), name_(params.name), id_(params.id) {
  Issues coils;
  std::visit([&](const auto& kind) { add(kind, coils); }, params.coils);
  if (coils.empty()) check_names(coils);
  Issues issues;
  issues.add_within("coils", coils);
  const std::size_t given = params.amplifiers.size();
  if (coils.empty() && given > 1 && given != size())
    issues.add("drives",
               fmt::format("drives has {} entries, must have one, or {}, one for each coil", given,
                           size()));
  keys.require_none(issues);
  for (std::size_t i = 0; i < size(); ++i)
    amplifiers_.push_back(given == 0 ? AmplifierParams{} : params.amplifiers[given == 1 ? 0 : i]);
}

void CoilSystem::limit_current(double most) {
  for (AmplifierParams& amplifier : amplifiers_)
    amplifier.max_current = std::min(most, amplifier.max_current.value_or(most));
}

void CoilSystem::check_names(Issues& issues) const {
  if (names_.empty() || names_.size() > max_coils_of_set)
    issues.add("", fmt::format("{} coils, allowed 1..{}", names_.size(), max_coils_of_set));
  for (std::size_t i = 0; i < names_.size(); ++i)
    if (std::find(names_.begin() + static_cast<std::ptrdiff_t>(i) + 1, names_.end(), names_[i]) !=
        names_.end())
      issues.add("", fmt::format("two coils are called {}", quote(names_[i])));
}

void CoilSystem::add(const HelmholtzCoils& params, Issues& issues) {
  centre_ = to_vector(params.centre, "centre_um", issues);
  const Eigen::Vector3d radius = to_vector(params.radius, "radius_um", issues);
  const Eigen::Vector3d turns = to_vector(params.turns, "turns", issues);
  std::vector<LoopCoil> pairs;
  for (int axis = 0; axis < 3 && issues.empty(); ++axis) {
    LoopCoil pair{axis_names[static_cast<std::size_t>(axis)], {}};
    for (const double side : {-0.5, 0.5}) {
      if (!issues.empty()) return;
      const Eigen::Vector3d middle = centre_ + side * radius[axis] * Eigen::Vector3d::Unit(axis);
      append(pair.loops, to_loops(winding(middle, axis, radius[axis], turns[axis], params.length,
                                          params.thickness),
                                  issues));
    }
    names_.push_back(pair.name);
    pairs.push_back(std::move(pair));
  }
  model_ = std::move(pairs);
}

void CoilSystem::add(const CubeCoils& params, Issues& issues) {
  centre_ = to_vector(params.centre, "centre_um", issues);
  std::vector<LoopCoil> coils;
  for (int axis = 0; axis < 3; ++axis)
    for (const int side : {-1, 1}) {
      if (!issues.empty()) return;
      const Eigen::Vector3d middle = centre_ + side * params.distance * Eigen::Vector3d::Unit(axis);
      LoopCoil coil{axis_names[static_cast<std::size_t>(axis)] + std::string(side < 0 ? "-" : "+"),
                    to_loops(winding(middle, axis, params.radius, params.turns, params.length,
                                     params.thickness),
                             issues)};
      names_.push_back(coil.name);
      coils.push_back(std::move(coil));
    }
  model_ = std::move(coils);
}

void CoilSystem::add(const LoopCoils& params, Issues& issues) {
  std::vector<LoopCoil> coils;
  std::size_t windings = 0;
  for (std::size_t i = 0; i < params.coils.size(); ++i) {
    const CoilParams& given = params.coils[i];
    Issues of_coil;
    if (given.name.empty()) of_coil.add("name", "name is empty");
    if (given.windings.empty())
      of_coil.add("windings", fmt::format("coil {} has no windings", quote(given.name)));
    LoopCoil coil{given.name, {}};
    for (std::size_t k = 0; k < given.windings.size(); ++k) {
      Issues of_winding;
      append(coil.loops, to_loops(given.windings[k], of_winding));
      if (of_winding.empty()) centre_ += to_vector(given.windings[k].centre, "", of_winding);
      of_coil.add_within(fmt::format("windings.{}", k), of_winding);
      ++windings;
    }
    issues.add_within(fmt::format("coils.{}", i), of_coil);
    names_.push_back(coil.name);
    coils.push_back(std::move(coil));
  }
  if (windings > 0) centre_ /= static_cast<double>(windings);
  model_ = std::move(coils);
}

std::optional<std::string> CoilSystem::beside(const std::string& file, std::string_view key,
                                              Issues& issues) const {
  if (!file.empty()) return (folder_ / file).string();
  issues.add(key, fmt::format("{} is empty", key));
  return std::nullopt;
}

void CoilSystem::add(const MpemCoils& params, Issues& issues) {
  const auto file = beside(params.file, "file", issues);
  if (!file) return;
  MpemSystem system = read_mpem(*file);
  if (name_.empty()) name_ = system.name;
  for (const MpemCoil& coil : system.coils) names_.push_back(coil.name);
  const Eigen::Vector3d middle = 0.5 * (system.lo + system.hi);
  if (middle.allFinite()) centre_ = middle;
  model_ = std::move(system);
}

void CoilSystem::add(const VfieldCoils& params, Issues& issues) {
  std::vector<FieldGrid> grids;
  for (const std::string& name : params.files) {
    const auto file = beside(name, "files", issues);
    if (!file) return;
    grids.push_back(read_vfield(*file));
    names_.push_back(std::filesystem::path(name).stem().string());
  }
  if (!grids.empty()) centre_ = 0.5 * (grids[0].lo() + grids[0].hi());
  model_ = std::move(grids);
}

namespace {

/// The rows of a matrix with a column for each of `columns` coils.
Eigen::MatrixXd to_matrix(const std::vector<std::vector<double>>& rows, std::size_t count,
                          std::size_t columns, const std::string& key, Issues& issues) {
  Eigen::MatrixXd matrix =
      Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(count), static_cast<Eigen::Index>(columns));
  if (rows.size() != count) {
    issues.add(key, fmt::format("{} has {} rows, must have {}", key, rows.size(), count));
    return matrix;
  }
  for (std::size_t row = 0; row < count; ++row) {
    if (rows[row].size() != columns) {
      issues.add(key, fmt::format("row {} of {} has {} numbers, there are {} names", row + 1, key,
                                  rows[row].size(), columns));
      return matrix;
    }
    for (std::size_t i = 0; i < columns; ++i)
      matrix(static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(i)) = rows[row][i];
  }
  return matrix;
}

}  // namespace

void CoilSystem::add(const MatrixCoils& params, Issues& issues) {
  names_ = params.names;
  centre_ = to_vector(params.centre, "centre_um", issues);
  offset_.field = to_vector(params.offset, "offset_mt", issues);
  if (params.offset_gradient.size() != 5)
    issues.add("offset_gradient_t_per_m",
               fmt::format("offset_gradient_t_per_m has {} numbers, must have 5",
                           params.offset_gradient.size()));
  else
    offset_.gradient =
        microswarm::actuation::gradient_matrix(FiveGradients(params.offset_gradient.data())) *
        mt_per_um_of_t_per_m;
  LinearField linear;
  linear.field = to_matrix(params.field, 3, size(), "field_mt_per_a", issues);
  linear.gradients = Eigen::MatrixXd::Zero(5, static_cast<Eigen::Index>(size()));
  if (!params.gradient.empty())
    linear.gradients = to_matrix(params.gradient, 5, size(), "gradient_t_per_m_per_a", issues) *
                       mt_per_um_of_t_per_m;
  model_ = std::move(linear);
}

bool CoilSystem::in_workspace(const Eigen::Vector3d& place) const {
  return std::visit(
      Overloaded{[&](const MpemSystem& mpem) { return mpem.in_workspace(place); },
                 [&](const std::vector<FieldGrid>& grids) {
                   return std::ranges::all_of(
                       grids, [&](const FieldGrid& grid) { return grid.contains(place); });
                 },
                 [](const OneOf<std::vector<LoopCoil>, LinearField> auto&) { return true; }},
      model_);
}

Actuation CoilSystem::at(const Eigen::Vector3d& position) const {
  const auto n = static_cast<Eigen::Index>(size());
  Actuation result{Eigen::Matrix3Xd::Zero(3, n),
                   Eigen::Matrix<double, 5, Eigen::Dynamic>::Zero(5, n), offset_};
  const auto put = [&](std::size_t i, const FieldGradient& one) {
    result.field.col(static_cast<Eigen::Index>(i)) = one.field;
    result.gradients.col(static_cast<Eigen::Index>(i)) = five_gradients(one.gradient);
  };
  const auto of_loops = [&](const std::vector<LoopCoil>& coils) {
    for (std::size_t i = 0; i < size(); ++i) put(i, field_at(coils[i].loops, position));
  };
  const auto of_sources = [&](const MpemSystem& mpem) {
    for (std::size_t i = 0; i < size(); ++i)
      put(i, microswarm::actuation::field_at(mpem.coils[i].sources, position));
    result.offset += microswarm::actuation::field_at(mpem.offset, position);
  };
  const auto of_grids = [&](const std::vector<FieldGrid>& grids) {
    for (std::size_t i = 0; i < size(); ++i) {
      const FieldGrid& grid = grids[i];
      if (!grid.contains(position))
        throw InputError(fmt::format("position {} is outside of the grid of {}, {} to {}",
                                     place_text(position), names_[i], place_text(grid.lo()),
                                     place_text(grid.hi())));
      put(i, grid.at(position));
    }
  };
  const auto of_line = [&](const LinearField& linear) {
    const Eigen::Vector3d off = position - centre_;
    for (std::size_t i = 0; i < size(); ++i) {
      const auto k = static_cast<Eigen::Index>(i);
      const Eigen::Matrix3d gradient =
          microswarm::actuation::gradient_matrix(linear.gradients.col(k));
      put(i, {linear.field.col(k) + gradient * off, gradient});
    }
    result.offset.field += offset_.gradient * off;
  };
  std::visit(Overloaded{of_loops, of_sources, of_grids, of_line}, model_);
  return result;
}

CoilSystem read_coil_system(const std::filesystem::path& path) {
  KeyLocations keys;
  const auto params = read_yaml_file<CoilSystemParams>(path, {}, keys);
  return CoilSystem(params, keys, input_folder(path));
}

}  // namespace microswarm::actuation
