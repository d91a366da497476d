// SPDX-License-Identifier: Apache-2.0
#include "microswarm/environments/gathering/particle_motion.hpp"

#include <algorithm>
#include <cmath>

namespace microswarm::environments {
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

/// Temporary memory of a step. Each thread has one, so that many gatherings fit into its caches.
struct ParticleMotion::Scratch {
  std::vector<std::uint32_t> aims;    ///< cells into which the particles would move
  std::vector<std::uint8_t> moves;    ///< whether they do
  std::vector<double> shares;         ///< 1 for those that do, 0 for those that are stopped
  std::vector<std::uint32_t> movers;  ///< those that change their cell
  std::vector<std::uint32_t> at;      ///< of each cell, particles or group + 1; 0 between steps

  static Scratch& of_thread(std::size_t cells, std::size_t particles) {
    thread_local Scratch scratch;
    if (scratch.at.size() < cells) scratch.at.resize(cells, 0);
    if (scratch.aims.size() < particles) {
      scratch.aims.resize(particles);
      scratch.moves.resize(particles);
      scratch.shares.resize(particles);
    }
    return scratch;
  }
};

ParticleMotion::ParticleMotion(const GatheringMaze& maze, const GatheringRules& rules)
    : maze_(maze), rules_(rules) {}

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
  std::vector<std::uint32_t>& at = Scratch::of_thread(maze_.size(), 0).at;
  std::uint32_t kept = 0;
  for (std::size_t i = 0; i < cells_.size(); ++i) {
    std::uint32_t& other = at[cells_[i]];
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
  for (const std::uint32_t cell : cells_) at[cell] = 0;
}

void ParticleMotion::step_algorithmic(MazePlace move) {
  const auto offset = static_cast<std::uint32_t>(move.row * maze_.stride() + move.column);
  for (std::uint32_t& cell : cells_)
    cell += maze_.is_free(cell + offset) ? offset
                                         : 0;  // without a branch, which could not be predicted
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
  Scratch& scratch = Scratch::of_thread(maze_.size(), n);
  std::vector<std::uint32_t>& aims = scratch.aims;
  std::vector<std::uint8_t>& moves = scratch.moves;
  accelerate(rows_, move.row);
  accelerate(columns_, move.column);
  const double last_row = maze_.height() - 1;
  const double last_column = maze_.width() - 1;
  const auto find_cell = [](const Axis& axis, std::size_t i, double last) {
    const double exact = axis.at[i] + axis.speed[i];
    return static_cast<int>(nearest(std::min(std::max(exact, 0.0), last)));
  };
  for (std::size_t i = 0; i < n; ++i) {
    aims[i] = maze_.number({find_cell(rows_, i, last_row), find_cell(columns_, i, last_column)});
    moves[i] = maze_.is_free(aims[i]);
  }
  if (rules_.particle_self_collision) block_full_cells(scratch);
  for (std::size_t i = 0; i < n; ++i) {
    const bool does = (moves[i] != 0) | (aims[i] == cells_[i]);
    cells_[i] = does ? aims[i] : cells_[i];
    scratch.shares[i] = does ? 1 : 0;
  }
  advance(rows_, scratch);
  advance(columns_, scratch);
}

void ParticleMotion::accelerate(Axis& axis, int direction) {
  for (std::size_t i = 0; i < cells_.size(); ++i) axis.speed[i] += direction * accelerations_[i];
}

// Without a branch, so that it is vectorised.
void ParticleMotion::advance(Axis& axis, const Scratch& scratch) {
  constexpr double slowest = 0.01;
  const double drag = rules_.drag;
  const double* const shares = scratch.shares.data();
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

// Particles that would enter an overfull cell stay, until no cell holds more than its capacity. All
// particles of a round are judged by the same counts; each round except the last stops one or more.
void ParticleMotion::block_full_cells(Scratch& scratch) {
  const std::vector<std::uint32_t>& aims = scratch.aims;
  std::vector<std::uint8_t>& moves = scratch.moves;
  std::vector<std::uint32_t>& movers = scratch.movers;
  std::vector<std::uint32_t>& at = scratch.at;
  const auto most = static_cast<std::uint32_t>(rules_.max_particles_per_cell);
  movers.resize(cells_.size());
  std::size_t count = 0;
  for (std::uint32_t i = 0; i < cells_.size(); ++i) {
    const bool does = (moves[i] != 0) & (aims[i] != cells_[i]);
    ++at[does ? aims[i] : cells_[i]];
    movers[count] = i;
    count += does;
  }
  movers.resize(count);
  for (std::size_t blocked = 1; blocked > 0;) {
    const auto fits = [&](std::uint32_t i) { return at[aims[i]] <= most; };
    const auto first = std::partition(movers.begin(), movers.end(), fits);
    blocked = static_cast<std::size_t>(movers.end() - first);
    for (auto i = first; i != movers.end(); ++i) {
      moves[*i] = 0;
      --at[aims[*i]];
      ++at[cells_[*i]];
    }
    movers.erase(first, movers.end());
  }
  for (const std::uint32_t i : movers) at[aims[i]] = 0;
  for (const std::uint32_t cell : cells_) at[cell] = 0;
}

}  // namespace microswarm::environments
