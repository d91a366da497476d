// SPDX-License-Identifier: Apache-2.0
#include "microswarm/navigation/radar/safety_radius.hpp"

#include <algorithm>

namespace microswarm::navigation {

// On the line from the obstacle to the swarm, Eq 20, 21 are one number: the gap x from edge to edge
// with x_{i+1} = x_i − T u_i, u = |v_r| in [0, |v_r|max] and T u < x_0 (Eq 22). The second input of
// Eq 20 turns the line, which does not change a distance: its optimum is 0, at no cost. Eq 23
// is then J = Σ Q x_i² + R u_i², i = 0 … N.
//
// Without bounds its optimum is u_i = K_i x_i by the Riccati recursion below, with T K_i < 1: so x
// stays positive, Eq 22 holds, and u_i falls with i since K_i and x_i do.
//
// With the bound v = |v_r|max the first input is min(K_0 x_0, v). The optimum obeys
// u_k = clip(T Q / R · Σ_{i>k} x_i, 0, v), in which no x_i is negative (after the first one that
// were, all sums would be, so the input before it would be 0), hence u_k falls with k here too. If
// u_0 were below v, all u_k would be: the bound would be inactive, the optimum would be the
// unbounded one, and u_0 = K_0 x_0. So either u_0 = K_0 x_0 <= v, or u_0 = v.
SafetyRadius::SafetyRadius(const SafetyRadiusParams& params) : params_(params) {
  const double T = params.sample_time;
  const double R = params.speed_weight;
  double cost = params.collision_weight;  // P_N: u_N has no effect on the cost
  for (int i = 0; i < params.horizon; ++i) {
    const double denominator = R + T * T * cost;
    gain_ = T * cost / denominator;
    cost = params.collision_weight + cost * (R / denominator);
  }
}

double SafetyRadius::assumed_speed(double gap) const {
  return std::clamp(gain_ * gap, 0.0, params_.max_relative_speed);
}

double SafetyRadius::radius(double greatest, double least, double gap) const {
  if (!params_.adaptive) return greatest;
  return std::max(least, greatest - assumed_speed(gap) * params_.assumed_time);  // Eq 24
}

}  // namespace microswarm::navigation
