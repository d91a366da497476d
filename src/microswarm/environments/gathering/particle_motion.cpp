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
  shares_.resize(n);
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
    cell += maze_.is_free(cell + offset) ? offset : 0;  // no branch, which would be a guess
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
    const std::uint64_t second = mixed(first);
    const int strays_now = (first & 0xffffffff) < strays ? 1 : 0;
    const int row = move.row + strays_now * chosen(second & 0xffff);
    const int column = move.column + strays_now * chosen((second >> 16) & 0xffff);
    const auto offset = static_cast<std::uint32_t>(row * maze_.stride() + column);
    const bool moves = (first >> 32) >= stays && maze_.is_free(cell + offset);
    cell += moves ? offset : 0;
  }
}

void ParticleMotion::step_physical(MazePlace move) {
  const std::size_t n = cells_.size();
  accelerate(rows_, move.row);
  accelerate(columns_, move.column);
  const double last_row = maze_.height() - 1;
  const double last_column = maze_.width() - 1;
  const auto cell_of = [](const Axis& axis, std::size_t i, double last) {
    const double at = axis.at[i] + axis.speed[i];
    return static_cast<int>(nearest(std::min(std::max(at, 0.0), last)));
  };
  for (std::size_t i = 0; i < n; ++i) {
    aims_[i] = maze_.number({cell_of(rows_, i, last_row), cell_of(columns_, i, last_column)});
    moves_[i] = maze_.is_free(aims_[i]);
  }
  if (rules_.particle_self_collision) block_full_cells();
  for (std::size_t i = 0; i < n; ++i) {
    const bool moves = (moves_[i] != 0) | (aims_[i] == cells_[i]);
    cells_[i] = moves ? aims_[i] : cells_[i];
    shares_[i] = moves ? 1 : 0;
  }
  advance(rows_);
  advance(columns_);
}

void ParticleMotion::accelerate(Axis& axis, int direction) {
  for (std::size_t i = 0; i < cells_.size(); ++i) axis.speed[i] += direction * accelerations_[i];
}

// Without a branch, so that several particles are done at once.
void ParticleMotion::advance(Axis& axis) {
  constexpr double slowest = 0.01;
  const double drag = rules_.drag;
  const double* const shares = shares_.data();
  double* const places = axis.at.data();
  double* const speeds = axis.speed.data();
  const std::size_t n = cells_.size();
  for (std::size_t i = 0; i < n; ++i) {
    const double at = places[i] + shares[i] * speeds[i];
    const double speed = speeds[i] / drag * (0.25 + 0.75 * shares[i]);  // a quarter in a contact
    const double whole = nearest(at);
    const bool is_fast = std::abs(speed) > slowest;
    speeds[i] = is_fast ? speed : 0;
    places[i] = is_fast ? at : whole;
  }
}

// Those that would come into a cell with too many stay, until no cell has more than fit. All of a
// round are judged by the same counts; each round but the last stops at least one.
void ParticleMotion::block_full_cells() {
  const auto most = static_cast<std::uint32_t>(rules_.max_particles_per_cell);
  movers_.resize(cells_.size());
  std::size_t movers = 0;
  for (std::uint32_t i = 0; i < cells_.size(); ++i) {
    const bool moves = (moves_[i] != 0) & (aims_[i] != cells_[i]);
    ++at_[moves ? aims_[i] : cells_[i]];
    movers_[movers] = i;
    movers += moves;
  }
  movers_.resize(movers);
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
