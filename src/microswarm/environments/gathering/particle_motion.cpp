// SPDX-License-Identifier: Apache-2.0
#include "microswarm/environments/gathering/particle_motion.hpp"

#include <algorithm>
#include <cmath>

namespace microswarm {
namespace {

/// A hash of 64 bits, each of which depends on all bits of `x` (finaliser of SplitMix64).
constexpr std::uint64_t mixed(std::uint64_t x) {
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ULL;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebULL;
  return x ^ (x >> 31);
}

/// The nearest whole number, the even one of two; |v| < 2^51.
double nearest(double v) {
  constexpr double unit = 0x1.8p52;  // from here on doubles are whole
  return (v + unit) - unit;
}

/// 2^32 times a probability.
std::uint64_t threshold(double probability) {
  return static_cast<std::uint64_t>(probability * 0x1p32);
}

}  // namespace

ParticleMotion::ParticleMotion(const GatheringMaze& maze, const GatheringRules& rules)
    : maze_(maze), rules_(rules) {
  at_.assign(maze_.size(), 0);
}

void ParticleMotion::place(std::vector<std::uint32_t> cells, Rng& rng) {
  cells_ = std::move(cells);
  counts_.assign(cells_.size(), 1);
  steps_ = 0;
  if (rules_.physics != ParticlePhysics::physical) return;
  const std::size_t n = cells_.size();
  rows_ = {std::vector<double>(n), std::vector<double>(n, 0.0)};
  columns_ = rows_;
  weights_.resize(n);
  accelerations_.resize(n);
  aims_.resize(n);
  moves_.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    const MazePlace at = maze_.place(cells_[i]);
    rows_.at[i] = at.row;
    columns_.at[i] = at.column;
    weights_[i] = 1 + (rules_.max_particle_weight - 1) * rng.uniform();
    accelerations_[i] = rules_.force / weights_[i];
  }
}

void ParticleMotion::step(std::size_t action, Rng& rng) {
  const MazePlace move = GatheringMaze::moves[action];
  switch (rules_.physics) {
    case ParticlePhysics::algorithmic:
      step_algorithmic(move);
      break;
    case ParticlePhysics::fuzzy:
      step_fuzzy(move, rng.bits());
      break;
    case ParticlePhysics::physical:
      return step_physical(move);
  }
  constexpr int between_merges = 8;
  if (++steps_ % between_merges == 0) merge_groups();
}

void ParticleMotion::merge_groups() {
  std::uint32_t kept = 0;
  for (std::size_t i = 0; i < cells_.size(); ++i) {
    std::uint32_t& other = at_[cells_[i]];
    if (other != 0) {
      counts_[other - 1] += counts_[i];
      continue;
    }
    cells_[kept] = cells_[i];
    counts_[kept] = counts_[i];
    other = ++kept;
  }
  cells_.resize(kept);
  counts_.resize(kept);
  for (const std::uint32_t cell : cells_) at_[cell] = 0;
}

void ParticleMotion::step_algorithmic(MazePlace move) {
  const auto offset = static_cast<std::uint32_t>(move.row * maze_.stride() + move.column);
  for (std::uint32_t& cell : cells_)
    if (maze_.is_free(cell + offset)) cell += offset;
}

void ParticleMotion::step_fuzzy(MazePlace move, std::uint64_t key) {
  const std::uint64_t strays = threshold(rules_.random_move_chance);
  const std::uint64_t stays = threshold(rules_.fuzzy_action_probability);
  const auto choices = static_cast<std::uint64_t>(2 * rules_.random_move_distance + 1);
  const auto chosen = [&](std::uint64_t bits) {
    return static_cast<int>((bits * choices) >> 16) - rules_.random_move_distance;
  };
  for (std::uint32_t& cell : cells_) {
    const std::uint64_t first = mixed(key + cell * 0x9e3779b97f4a7c15ULL);
    if ((first >> 32) < stays) continue;
    int row = move.row;
    int column = move.column;
    const std::uint64_t second = mixed(first);
    if ((first & 0xffffffff) < strays) {
      row += chosen(second & 0xffff);
      column += chosen((second >> 16) & 0xffff);
    }
    const auto offset = static_cast<std::uint32_t>(row * maze_.stride() + column);
    if (maze_.is_free(cell + offset)) cell += offset;
  }
}

void ParticleMotion::step_physical(MazePlace move) {
  const std::size_t n = cells_.size();
  accelerate(rows_, move.row);
  accelerate(columns_, move.column);
  const double last_row = maze_.height() - 1;
  const double last_column = maze_.width() - 1;
  for (std::size_t i = 0; i < n; ++i) {
    const double row = nearest(std::clamp(rows_.at[i] + rows_.speed[i], 0.0, last_row));
    const double column = nearest(std::clamp(columns_.at[i] + columns_.speed[i], 0.0, last_column));
    aims_[i] = maze_.number({static_cast<int>(row), static_cast<int>(column)});
    moves_[i] = maze_.is_free(aims_[i]);
  }
  if (rules_.particle_self_collision) block_full_cells();
  for (std::size_t i = 0; i < n; ++i) {
    if (aims_[i] == cells_[i]) moves_[i] = 1;
    if (moves_[i] != 0) cells_[i] = aims_[i];
  }
  advance(rows_);
  advance(columns_);
}

void ParticleMotion::accelerate(Axis& axis, int direction) {
  for (std::size_t i = 0; i < cells_.size(); ++i) axis.speed[i] += direction * accelerations_[i];
}

void ParticleMotion::advance(Axis& axis) {
  constexpr double slowest = 0.01;
  for (std::size_t i = 0; i < cells_.size(); ++i) {
    const bool moves = moves_[i] != 0;
    double at = axis.at[i];
    double speed = axis.speed[i];
    at = moves ? at + speed : at;
    speed /= rules_.drag;
    speed = moves ? speed : speed / 4;
    const bool is_fast = std::abs(speed) > slowest;
    axis.speed[i] = is_fast ? speed : 0;
    axis.at[i] = is_fast ? at : nearest(at);
  }
}

// Those that would come into a cell with too many stay, until no cell has more than fit. All of a
// round are judged by the same counts; each round but the last stops at least one.
void ParticleMotion::block_full_cells() {
  const auto most = static_cast<std::uint32_t>(rules_.max_particles_per_cell);
  movers_.clear();
  for (std::uint32_t i = 0; i < cells_.size(); ++i) {
    const bool moves = moves_[i] != 0 && aims_[i] != cells_[i];
    ++at_[moves ? aims_[i] : cells_[i]];
    if (moves) movers_.push_back(i);
  }
  for (std::size_t blocked = 1; blocked > 0;) {
    const auto fits = [&](std::uint32_t i) { return at_[aims_[i]] <= most; };
    const auto first = std::partition(movers_.begin(), movers_.end(), fits);
    blocked = static_cast<std::size_t>(movers_.end() - first);
    for (auto i = first; i != movers_.end(); ++i) {
      moves_[*i] = 0;
      --at_[aims_[*i]];
      ++at_[cells_[*i]];
    }
    movers_.erase(first, movers_.end());
  }
  for (const std::uint32_t i : movers_) at_[aims_[i]] = 0;
  for (const std::uint32_t cell : cells_) at_[cell] = 0;
}

}  // namespace microswarm
