// SPDX-License-Identifier: Apache-2.0
#include "microswarm/rig/identify/driven_path.hpp"

#include <algorithm>
#include <cmath>

#include "microswarm/actuation/field/waveform.hpp"

namespace microswarm::rig {
namespace {

constexpr double path_step = 0.005;  // [s]
constexpr std::size_t max_steps = 2'000'000;

/// Displacement of a body that follows the next step of the generator.
Vec2 advance(actuation::FieldGenerator& generator, const actuation::FieldGeneratorParams& field) {
  if (field.kind != actuation::FieldKind::rolling) {
    generator.advance(path_step);
    return path_step * field.speed_per_pitch * generator.pitch() * unit_vector(generator.heading());
  }
  const Eigen::Vector3d before = generator.field();
  return actuation::rolled_distance(before, generator.advance(path_step), field.length_per_turn);
}

}  // namespace

DrivenPath::DrivenPath(const actuation::FieldGeneratorParams& field,
                       std::span<const DrivenCommand> commands, double after) {
  points_.push_back({});
  if (commands.empty()) return;
  actuation::FieldGeneratorParams straight = field;
  straight.heading_offset = 0;
  begin_ = commands.front().t;
  actuation::FieldGenerator generator(straight, commands.front().command.heading);
  const auto count = static_cast<std::size_t>(
      std::clamp((commands.back().t + after - begin_) / path_step, 0.0, double{max_steps}));
  std::size_t next = 0;
  for (std::size_t i = 0; i < count; ++i) {
    for (; next < commands.size() &&
           commands[next].t <= begin_ + path_step * (static_cast<double>(i) + 0.5);
         ++next) {
      generator.command(commands[next].command);
      generator.set_frequency(commands[next].frequency);
    }
    const Vec2 moved = advance(generator, straight);
    length_ += norm(moved);
    points_.push_back(points_.back() + moved);
  }
}

Vec2 DrivenPath::at(double t) const {
  const double i = (t - begin_) / path_step;
  if (i <= 0) return points_.front();
  const auto k = static_cast<std::size_t>(i);
  if (i >= static_cast<double>(points_.size() - 1)) return points_.back();
  return points_[k] + (i - static_cast<double>(k)) * (points_[k + 1] - points_[k]);
}

}  // namespace microswarm::rig
