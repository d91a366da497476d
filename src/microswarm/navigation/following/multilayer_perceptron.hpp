// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace microswarm::navigation {

/// Small fully connected network with tanh after every layer but the last. `weights` holds, layer
/// by layer and output by output, the weights of the inputs and then the bias.
struct MultilayerPerceptron {
  static constexpr std::size_t max_width = 64;
  std::vector<std::size_t>
      layers{};  ///< number of inputs, then of each layer's outputs; at most max_width
  std::vector<double> weights{};

  /// Number of weights of a network with these layers.
  static std::size_t weight_count(std::span<const std::size_t> layers);

  /// Evaluates the network; `in` and `out` have the sizes of the first and last layer. Does not
  /// allocate.
  void evaluate(std::span<const double> in, std::span<double> out) const;
};

}  // namespace microswarm::navigation
