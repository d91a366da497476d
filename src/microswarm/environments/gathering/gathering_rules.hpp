// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string_view>
#include <utility>

#include "microswarm/core/fields/fields.hpp"

namespace microswarm::environments {

/// Motion of particles under an input.
enum class ParticlePhysics {
  algorithmic,  ///< one cell in its direction, unless that cell is a wall
  fuzzy,        ///< the same with random errors, equal for all particles in a cell
  physical,     ///< with mass, drag and contacts between particles
};
constexpr auto enum_names(ParticlePhysics) {
  return std::array<std::pair<ParticlePhysics, std::string_view>, 3>{
      {{ParticlePhysics::algorithmic, "algorithmic"},
       {ParticlePhysics::fuzzy, "fuzzy"},
       {ParticlePhysics::physical, "physical"}}};
}

/// Number of particles in an episode.
enum class ParticleCount {
  fixed,   ///< always as many
  random,  ///< at least one, fewer than there are free cells and than 4,500
  filled,  ///< one in every free cell
};
constexpr auto enum_names(ParticleCount) {
  return std::array<std::pair<ParticleCount, std::string_view>, 3>{
      {{ParticleCount::fixed, "fixed"},
       {ParticleCount::random, "random"},
       {ParticleCount::filled, "filled"}}};
}

/// Picture of a state.
enum class GatheringObservation {
  simple,        ///< one channel: particles, and the goal if it is random
  multichannel,  ///< walls, particles, and the goal if it is random
};
constexpr auto enum_names(GatheringObservation) {
  return std::array<std::pair<GatheringObservation, std::string_view>, 2>{
      {{GatheringObservation::simple, "simple"},
       {GatheringObservation::multichannel, "multichannel"}}};
}

/// Rules of the learning benchmark gym-gathering (Konitzny, Lu, Leclerc, Fekete and Becker,
/// "Gathering Physical Particles with a Global Magnetic Field Using Reinforcement Learning", IROS
/// 2022); names and defaults are the benchmark's. Lengths are cells, times steps.
struct GatheringRules {
  static constexpr std::string_view type_name = "gathering";
  ParticlePhysics physics = ParticlePhysics::algorithmic;
  ParticleCount particle_count = ParticleCount::fixed;
  int n_particles = 256;
  int goal_range = 10;
  int max_episode_steps = 2000;
  GatheringObservation observation = GatheringObservation::simple;
  bool total_cost_reward = true;
  bool max_cost_reward = true;
  bool time_penalty = true;
  double random_move_chance = 0.25;
  int random_move_distance = 1;
  double fuzzy_action_probability = 0.25;
  double force = 0.05;
  double drag = 1.025;
  double max_particle_weight = 1.2;
  bool particle_self_collision = true;
  int max_particles_per_cell = 3;
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.physics, plain("physics", "How particles follow an input."));
    visit(self.particle_count, plain("particle_count", "How many particles an episode has."));
    visit(self.n_particles, plain("n_particles", 1, 1e6, "Number of particles, if it is fixed."));
    visit(self.goal_range,
          plain("goal_range", 0, 1e6, "Steps to the goal within which all must be."));
    visit(self.max_episode_steps,
          plain("max_episode_steps", 1, 1e9, "Steps after which an episode is cut."));
    visit(self.observation, plain("observation", "Channels of the picture."));
    visit(self.total_cost_reward,
          plain("total_cost_reward", "Reward the decrease of the total distance."));
    visit(self.max_cost_reward,
          plain("max_cost_reward", "Reward the decrease of the largest distance."));
    visit(self.time_penalty, plain("time_penalty", "Every step costs."));
    visit(self.random_move_chance,
          plain("random_move_chance", 0, 1, "Fuzzy: share of cells with a random move."));
    visit(self.random_move_distance,
          plain("random_move_distance", 1, 7, "Fuzzy: longest random move."));
    visit(self.fuzzy_action_probability,
          plain("fuzzy_action_probability", 0, 1, "Fuzzy: share of cells that do not move."));
    visit(self.force, plain("force", 0, 1e3, "Physical: force of an input."));
    visit(self.drag, plain("drag", 1, 1e3, "Physical: loss of speed in a step, divisor."));
    visit(self.max_particle_weight,
          plain("max_particle_weight", 1, 1e3, "Physical: weights are from 1 to this."));
    visit(self.particle_self_collision,
          plain("particle_self_collision", "Physical: particles block each other."));
    visit(self.max_particles_per_cell,
          plain("max_particles_per_cell", 1, 60000, "Physical: so many fit into a cell."));
  }
};

}  // namespace microswarm::environments
