// SPDX-License-Identifier: Apache-2.0
#include "microswarm/environments/gathering/gathering_episode.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "microswarm/core/errors/error.hpp"

namespace microswarm::environments {
namespace {

constexpr std::uint8_t marked = 255;
constexpr std::size_t max_random_particles = 4500;

/// Calls `mark(row, column)` for each cell of a circle's line around the goal and for the goal
/// itself, two cells wide.
template <class Mark>
void draw_goal(MazePlace goal, int radius, Mark&& mark) {
  const auto points = [&](int across, int along) {
    for (const int a : {-across, across})
      for (const int b : {-along, along}) {
        mark(goal.row + a, goal.column + b);
        mark(goal.row + b, goal.column + a);
      }
  };
  int across = radius;
  for (int along = 0, error = 1 - radius; along <= across; ++along) {
    points(across, along);
    error += error < 0 ? 2 * along + 3 : 2 * (along - across--) + 5;
  }
  for (const int row : {-1, 0})
    for (const int column : {-1, 0}) mark(goal.row + row, goal.column + column);
}

}  // namespace

GatheringTask::GatheringTask(GatheringMaze of, const GatheringRules& given,
                             std::optional<MazePlace> at)
    : maze(std::move(of)), rules(given), goal(at), pixels(maze.size()) {
  for (const std::uint32_t cell : maze.cells()) {
    const MazePlace place = maze.place(cell);
    pixels[cell] = static_cast<std::uint32_t>(place.row * maze.width() + place.column);
  }
  if (goal) {
    if (!maze.is_free(*goal))
      throw InputError(fmt::format("goal ({}, {}) is no free cell of the maze of {} × {} cells",
                                   goal->column, goal->row, maze.width(), maze.height()));
    costs = maze.costs_to(maze.number(*goal));
  }
  if (rules.particle_count == ParticleCount::fixed &&
      static_cast<std::size_t>(rules.n_particles) > maze.cells().size())
    throw InputError(fmt::format("n_particles is {}, but only {} cells are free", rules.n_particles,
                                 maze.cells().size()));
}

int GatheringTask::channels() const {
  return rules.observation == GatheringObservation::simple ? 1 : goal ? 2 : 3;
}

std::size_t GatheringTask::picture_size() const {
  return static_cast<std::size_t>(maze.width()) * static_cast<std::size_t>(maze.height()) *
         static_cast<std::size_t>(channels());
}

std::size_t GatheringTask::episode_bytes() const {
  std::size_t particles = maze.cells().size();
  if (rules.particle_count == ParticleCount::fixed)
    particles = static_cast<std::size_t>(rules.n_particles);
  else if (rules.particle_count == ParticleCount::random)
    particles = std::min(particles, max_random_particles);
  const std::size_t a_particle = rules.physics == ParticlePhysics::physical ? 56 : 8;
  const std::size_t of_goal = goal ? 0 : 4 * maze.size() + picture_size();
  const auto inputs = static_cast<std::size_t>(std::min(rules.max_episode_steps, 100'000));
  constexpr std::size_t itself = 1000;
  return a_particle * particles + of_goal + inputs + itself;
}

GatheringEpisode::GatheringEpisode(const GatheringTask& task, std::uint64_t seed,
                                   std::span<std::uint8_t> picture)
    : task_(task),
      seed_(seed),
      rng_(seed, Purpose::learning),
      motion_(task_.maze, task_.rules),
      picture_(picture) {
  reset();
}

GatheringEpisode::GatheringEpisode(const GatheringEpisode& other, std::span<std::uint8_t> picture)
    : GatheringEpisode(other) {
  picture_ = picture;
  std::ranges::copy(other.picture_, picture_.begin());
}

void GatheringEpisode::reset(std::uint64_t seed) {
  seed_ = seed;
  rng_ = Rng(seed, Purpose::learning);
  drawn_ = 0;
  reset();
}

GatheringState GatheringEpisode::state() const {
  return {.seed = seed_, .draws = drawn_before_, .actions = actions_};
}

EnvironmentStep GatheringEpisode::restore(const GatheringState& state) {
  if (state.draws > GatheringState::max_draws)
    throw InputError(fmt::format("a state of an environment has {} draws, must be at most {}",
                                 state.draws, GatheringState::max_draws));
  for (const std::uint8_t action : state.actions)
    if (action >= GatheringMaze::moves.size())
      throw InputError(fmt::format("a state of an environment has the input {}, must be 0 to {}",
                                   action, GatheringMaze::moves.size() - 1));
  seed_ = state.seed;
  rng_ = Rng(seed_, Purpose::learning);
  for (std::uint64_t i = 0; i < state.draws; ++i) rng_.bits();
  drawn_ = state.draws;
  reset();
  EnvironmentStep made;
  for (const std::uint8_t action : state.actions) made = step(action);
  return made;
}

void GatheringEpisode::reset() {
  const GatheringMaze& maze = task_.maze;
  drawn_before_ = drawn_;
  actions_.clear();
  if (!task_.goal) {
    own_costs_ = maze.costs_to(maze.cells()[rng_.below(maze.cells().size())]);
    ++drawn_;
  }
  length_estimate_ = maze.episode_length_estimate(costs());
  // Only cells from which the goal can be reached.
  std::vector<std::uint32_t> cells;
  cells.reserve(maze.cells().size());
  for (const std::uint32_t cell : maze.cells())
    if (costs().of[cell] != MazeCosts::unreached) cells.push_back(cell);
  std::size_t n = cells.size();
  switch (task_.rules.particle_count) {
    case ParticleCount::fixed:
      n = std::min(n, static_cast<std::size_t>(task_.rules.n_particles));
      break;
    case ParticleCount::random:
      n = 1 + rng_.below(std::max<std::size_t>(std::min(n, max_random_particles), 2) - 1);
      ++drawn_;
      break;
    case ParticleCount::filled:
      break;
  }
  for (std::size_t i = 0; i < n; ++i) std::swap(cells[i], cells[i + rng_.below(cells.size() - i)]);
  cells.resize(n);
  motion_.place(std::move(cells), rng_);
  drawn_ += n + motion_.weights().size();  // for the cells and the weights
  steps_ = 0;
  start_total_ = std::max(costs().mean * static_cast<double>(n), 1.0);
  last_total_ = start_total_;
  last_max_ = costs().max;
  draw_background();
  draw_particles();
}

EnvironmentStep GatheringEpisode::step(std::size_t action) {
  erase_particles();
  motion_.step(action, rng_);
  draw_particles();
  if (task_.rules.physics == ParticlePhysics::fuzzy) ++drawn_;
  actions_.push_back(static_cast<std::uint8_t>(action));
  ++steps_;
  const Cost now = cost();
  const GatheringRules& rules = task_.rules;
  EnvironmentStep made;
  if (rules.total_cost_reward) made.reward += (last_total_ - now.total) / start_total_;
  if (rules.max_cost_reward) made.reward += (last_max_ - now.max) / std::max(1u, costs().max);
  if (rules.time_penalty) made.reward -= 1 / length_estimate_;
  last_total_ = now.total;
  last_max_ = now.max;
  made.terminated = now.max <= static_cast<std::uint32_t>(rules.goal_range);
  made.truncated = !made.terminated && steps_ >= rules.max_episode_steps;
  made.success = made.terminated;
  if (made.has_ended()) made.reason = made.terminated ? "gathered" : "step_limit";
  return made;
}

GatheringEpisode::Cost GatheringEpisode::cost() const {
  std::uint64_t total = 0;
  std::uint32_t max = 0;
  const std::vector<std::uint32_t>& of = costs().of;
  const auto cells = motion_.cells();
  const auto counts = motion_.counts();
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const std::uint32_t cost = of[cells[i]];
    total += std::uint64_t{cost} * counts[i];
    max = std::max(max, cost);
  }
  return {static_cast<double>(total), max};
}

void GatheringEpisode::draw_background() {
  const GatheringMaze& maze = task_.maze;
  const auto channels = static_cast<std::size_t>(task_.channels());
  std::ranges::fill(picture_, std::uint8_t{0});
  if (channels > 1) {
    std::size_t i = 0;
    for (int row = 0; row < maze.height(); ++row)
      for (int column = 0; column < maze.width(); ++column, i += channels)
        if (!maze.is_free(maze.number({row, column}))) picture_[i] = marked;
  }
  if (!task_.goal)
    draw_goal(maze.place(goal()), task_.rules.goal_range, [&](int row, int column) {
      if (row < 0 || row >= maze.height() || column < 0 || column >= maze.width()) return;
      const auto pixel = static_cast<std::size_t>(row * maze.width() + column);
      picture_[(pixel + 1) * channels - 1] = marked;
    });
  if (channels == 1 && !task_.goal) background_.assign(picture_.begin(), picture_.end());
}

void GatheringEpisode::draw_particles() {
  const std::size_t channels = static_cast<std::size_t>(task_.channels());
  const std::size_t channel = channels > 1 ? 1 : 0;
  for (const std::uint32_t cell : motion_.cells())
    picture_[task_.pixel(cell) * channels + channel] = marked;
}

void GatheringEpisode::erase_particles() {
  const std::size_t channels = static_cast<std::size_t>(task_.channels());
  const std::size_t channel = channels > 1 ? 1 : 0;
  for (const std::uint32_t cell : motion_.cells()) {
    const std::size_t at = task_.pixel(cell) * channels + channel;
    picture_[at] = background_.empty() ? std::uint8_t{0} : background_[at];
  }
}

}  // namespace microswarm::environments
