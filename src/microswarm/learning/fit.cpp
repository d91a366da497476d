// SPDX-License-Identifier: Apache-2.0
// The only file that uses dlib. Its matrices would use the machine's BLAS, whose order of summation
// varies; without BLAS, dlib sums in plain loops.
#include "microswarm/learning/fit.hpp"

#include <dlib/test_for_odr_violations.h>
#undef DLIB_USE_BLAS
#undef DLIB_USE_LAPACK
#include <dlib/optimization/optimization.h>

#include <algorithm>
#include <cmath>

namespace microswarm::learning {
namespace {

using Column = dlib::matrix<double, 0, 1>;

/// Loss at successive points; caches the last gradient, because dlib asks for value and gradient
/// separately.
class Objective {
 public:
  Objective(navigation::MultilayerPerceptron& network, const Examples& examples,
            const FitOptions& options)
      : network_(network), examples_(examples), options_(options) {}

  double value(const Column& weights) {
    if (weights.size() == at_.size() && std::equal(weights.begin(), weights.end(), at_.begin()))
      return value_;
    at_ = weights;
    std::copy(at_.begin(), at_.end(), network_.weights.begin());
    value_ = loss_with_gradient(network_, examples_, gradient_, options_.jobs);
    for (std::size_t w = 0; w < gradient_.size(); ++w) {
      const double weight = network_.weights[w];
      value_ += options_.decay * weight * weight;
      gradient_[w] += 2 * options_.decay * weight;
    }
    return value_;
  }

  Column slope(const Column& weights) {
    value(weights);
    Column slope(static_cast<long>(gradient_.size()));
    std::copy(gradient_.begin(), gradient_.end(), slope.begin());
    return slope;
  }

 private:
  navigation::MultilayerPerceptron& network_;
  const Examples& examples_;
  const FitOptions& options_;
  Column at_;
  double value_ = 0;
  std::vector<double> gradient_;
};

/// Stopping criterion for dlib.
class Limit {
 public:
  Limit(const FitOptions& options, const Stop& stop) : options_(options), stop_(stop) {}

  template <class T>
  bool should_continue_search(const T&, double, const T& slope) {
    if (options_.progress) options_.progress(done_);
    return done_++ < options_.iterations && dlib::length(slope) > 1e-9 && !stop_();
  }

 private:
  const FitOptions& options_;
  const Stop& stop_;
  int done_ = 0;
};

/// Initialises each layer with weights that preserve the variance (Glorot 2010).
void randomise(navigation::MultilayerPerceptron& network, Rng& rng) {
  auto w = network.weights.begin();
  for (std::size_t k = 0; k + 1 < network.layers.size(); ++k) {
    const std::size_t ins = network.layers[k], outs = network.layers[k + 1];
    const double most = std::sqrt(6.0 / static_cast<double>(ins + outs));
    for (std::size_t o = 0; o < outs; ++o) {
      for (std::size_t i = 0; i < ins; ++i) *w++ = rng.uniform(-most, most);
      *w++ = 0;
    }
  }
}

}  // namespace

navigation::MultilayerPerceptron fit(std::vector<std::size_t> layers, const Examples& examples,
                                     const FitOptions& options, Rng& rng, const Stop& stop) {
  navigation::MultilayerPerceptron network{.layers = std::move(layers), .weights = {}};
  network.weights.resize(navigation::MultilayerPerceptron::weight_count(network.layers));
  randomise(network, rng);
  Objective objective(network, examples, options);
  Column weights(static_cast<long>(network.weights.size()));
  std::copy(network.weights.begin(), network.weights.end(), weights.begin());
  dlib::find_min(
      dlib::lbfgs_search_strategy(20), Limit(options, stop),
      [&](const Column& w) { return objective.value(w); },
      [&](const Column& w) { return objective.slope(w); }, weights, 0);
  std::copy(weights.begin(), weights.end(), network.weights.begin());
  return network;
}

}  // namespace microswarm::learning
