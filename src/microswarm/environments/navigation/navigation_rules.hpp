// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "microswarm/core/fields/fields.hpp"

namespace microswarm::environments {

/// Observations and rewards of an agent that steers a swarm.
struct NavigationRules {
  static constexpr std::string_view type_name = "navigation";
  int rays = 8;
  double ray_range = 500;
  int obstacles = 4;
  bool random_start = false;
  bool random_goal = false;
  double arrival_reward = 1;
  double contact_penalty = 1;
  double time_penalty = 0.5;
  bool scaled = true;
  int max_episode_steps = 0;
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.rays, plain("rays", 0, 360, "Directions in which distances are seen."));
    visit(self.ray_range, um("ray_range", 1, 1e6, "Greatest distance that is seen."));
    visit(self.obstacles, plain("obstacles", 0, 1000, "Nearest obstacles that are seen."));
    visit(self.random_start, plain("random_start", "A random free start for each episode."));
    visit(self.random_goal, plain("random_goal", "A random free goal for each episode."));
    visit(self.arrival_reward, plain("arrival_reward", 0, 1e6, "Reward for reaching the goal."));
    visit(self.contact_penalty, plain("contact_penalty", 0, 1e6, "Reward that a contact costs."));
    visit(self.time_penalty,
          plain("time_penalty", 0, 1e6, "Reward that the whole time limit costs."));
    visit(self.scaled, plain("scaled", "Observations and actions from -1 to 1, not in um."));
    visit(self.max_episode_steps,
          plain("max_episode_steps", 0, 1e9, "Ticks after which it is cut; 0: no such limit."));
  }
};

}  // namespace microswarm::environments
