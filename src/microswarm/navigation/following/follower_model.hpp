// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "microswarm/navigation/following/follower_features.hpp"
#include "microswarm/navigation/following/multilayer_perceptron.hpp"

namespace microswarm {

/// A learned follower: a network, the range of each of its features in training, and how it came
/// about. Features enter the network scaled to [-1, 1] over their range. It answers with the
/// heading off the bearing [rad] and the share of the speed asked for.
struct FollowerModel {
  std::uint64_t seed = 0;
  std::string training;  ///< its parameters, on one line
  std::array<double, feature_count> lowest{};
  std::array<double, feature_count> highest{};
  MultilayerPerceptron network;

  /// The features as the network takes them; nothing when one is outside of its range.
  std::optional<std::array<double, feature_count>> scaled(
      std::array<double, feature_count> features) const;
  /// The command for this; nothing when a feature is outside of the range of the training.
  std::optional<Command> command(const FollowerQuery& query) const;
};

/// The slowest share of the speed asked for that a model commands.
inline constexpr double min_speed_share = 0.2;

/// A model as text: YAML that is easy to read for people, with numbers to the last bit.
std::string follower_model_text(const FollowerModel& model);

/// Reads that text back to the same bits. Throws InputError "NAME:LINE: WHY" for anything else:
/// keys out of order, a wrong count, a number that is not finite or too large, layers that do not
/// fit.
FollowerModel parse_follower_model(std::string_view text, std::string_view name);

/// The model that comes with the library: models/follower.yaml of the source tree.
const FollowerModel& default_follower_model();

}  // namespace microswarm
