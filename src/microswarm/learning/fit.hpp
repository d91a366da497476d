// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "microswarm/core/execution/stop.hpp"
#include "microswarm/core/maths/rng.hpp"
#include "microswarm/navigation/following/multilayer_perceptron.hpp"

namespace microswarm::learning {

/// Training examples: `inputs` and `answers` one after the other.
struct Examples {
  std::size_t in = 0;   ///< size of an input
  std::size_t out = 0;  ///< size of an answer
  std::vector<double> inputs{};
  std::vector<double> answers{};

  std::size_t count() const { return in > 0 ? inputs.size() / in : 0; }
};

/// Settings of `fit`.
struct FitOptions {
  int iterations = 300;
  double decay = 1e-6;  ///< weight of the sum of squared weights in the loss
  int jobs = 0;         ///< threads; 0: one per core
  std::function<void(int done)> progress{};
};

/// Mean squared distance between answer and network output over the examples, and its gradient with
/// respect to the weights (back-propagation). The order of summation does not depend on `jobs`.
double loss_with_gradient(const navigation::MultilayerPerceptron& network, const Examples& examples,
                          std::vector<double>& gradient, int jobs);

/// Fits a network with these layers to all examples by dlib's L-BFGS from random weights. The
/// result is bit-identical for equal examples and random stream, with any number of threads.
navigation::MultilayerPerceptron fit(std::vector<std::size_t> layers, const Examples& examples,
                                     const FitOptions& options, Rng& rng, const Stop& stop = {});

}  // namespace microswarm::learning
