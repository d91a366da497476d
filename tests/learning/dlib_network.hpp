// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <span>

#include "microswarm/navigation/following/multilayer_perceptron.hpp"

namespace microswarm::test {

/// The layers that dlib_answer() has.
inline constexpr std::array<std::size_t, 4> dlib_layers{6, 5, 4, 2};

/// What dlib's own layers (fc and htan, in float) answer with the weights of the network.
std::array<double, 2> dlib_answer(const navigation::MultilayerPerceptron& network,
                                  std::span<const double> in);

}  // namespace microswarm::test
