// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "microswarm/navigation/following/follower_features.hpp"
#include "microswarm/navigation/following/multilayer_perceptron.hpp"

namespace microswarm::navigation {

/// Learned follower: a network, the training range of each feature, and its training parameters.
/// Features are scaled to [-1, 1] over their range. The outputs are the heading relative to the
/// bearing [rad] and the fraction of the commanded speed.
struct FollowerModel {
  std::uint64_t seed = 0;
  std::string training{};  ///< training parameters, on one line
  std::array<double, feature_count> lowest{};
  std::array<double, feature_count> highest{};
  MultilayerPerceptron network{};

  /// Scaled features; nothing if one is outside its range.
  std::optional<std::array<double, feature_count>> scaled(
      std::array<double, feature_count> features) const;
  /// Command for the query; nothing if a feature is outside its training range.
  std::optional<Command> command(const FollowerQuery& query) const;
};

/// Minimum fraction of the commanded speed that a model commands.
inline constexpr double min_speed_share = 0.2;

/// Model as readable YAML, with numbers exact to the last bit.
std::string follower_model_text(const FollowerModel& model);

/// Reads that text back to the same bits. Throws InputError "NAME:LINE: WHY" for anything else:
/// keys out of order, a wrong count, a number that is not finite or too large, inconsistent layers.
FollowerModel parse_follower_model(std::string_view text, std::string_view name);

/// Built-in model: models/follower.yaml of the source tree.
const FollowerModel& default_follower_model();

}  // namespace microswarm::navigation
