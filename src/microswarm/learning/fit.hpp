// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "microswarm/core/rng.hpp"
#include "microswarm/core/stop.hpp"
#include "microswarm/navigation/following/multilayer_perceptron.hpp"

namespace microswarm {

/// What a network is to answer to what: `inputs` and `answers` hold the examples one by one.
struct Examples {
  std::size_t in = 0;   ///< numbers of an input
  std::size_t out = 0;  ///< numbers of an answer
  std::vector<double> inputs;
  std::vector<double> answers;

  std::size_t count() const { return in > 0 ? inputs.size() / in : 0; }
};

/// How to fit.
struct FitOptions {
  int iterations = 300;
  double decay = 1e-6;  ///< times the sum of squared weights is added to the loss
  int jobs = 0;         ///< threads; 0 takes one a core
  std::function<void(int done)> progress;
};

/// Mean over the examples of the squared distance between answer and network, with its gradient by
/// the weights (back-propagation). The sums run in an order that does not depend on `jobs`.
double loss_with_gradient(const MultilayerPerceptron& network, const Examples& examples,
                          std::vector<double>& gradient, int jobs);

/// A network of these layers that fits the examples: L-BFGS of dlib from random weights, all
/// examples at once. The same examples and stream give the same bits on any number of threads.
MultilayerPerceptron fit(std::vector<std::size_t> layers, const Examples& examples,
                         const FitOptions& options, Rng& rng, const Stop& stop = {});

}  // namespace microswarm
