// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace microswarm {

/// A small fully connected network: tanh after every layer but the last. `weights` holds, layer by
/// layer and output by output, the weights of its inputs and then its bias.
struct MultilayerPerceptron {
  static constexpr std::size_t max_width = 64;
  std::vector<std::size_t>
      layers;  ///< number of inputs, of each layer's outputs; at most max_width
  std::vector<double> weights;

  /// How many weights a network of these layers has.
  static std::size_t weight_count(std::span<const std::size_t> layers);

  /// The answer to `in`; both are as long as the first and the last layer. Allocates nothing.
  void evaluate(std::span<const double> in, std::span<double> out) const;
};

}  // namespace microswarm
