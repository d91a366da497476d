// SPDX-License-Identifier: Apache-2.0
#include "microswarm/navigation/following/multilayer_perceptron.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include "microswarm/core/maths/maths.hpp"

namespace microswarm::navigation {

std::size_t MultilayerPerceptron::weight_count(std::span<const std::size_t> layers) {
  std::size_t count = 0;
  for (std::size_t k = 0; k + 1 < layers.size(); ++k) count += (layers[k] + 1) * layers[k + 1];
  return count;
}

void MultilayerPerceptron::evaluate(std::span<const double> in, std::span<double> out) const {
  assert(layers.size() >= 2 && in.size() == layers.front() && out.size() == layers.back());
  std::array<double, max_width> values{}, next{};
  std::copy(in.begin(), in.end(), values.begin());
  const double* w = weights.data();
  for (std::size_t k = 0; k + 1 < layers.size(); ++k) {
    const bool last = k + 2 == layers.size();
    for (std::size_t o = 0; o < layers[k + 1]; ++o) {
      double sum = w[layers[k]];
      for (std::size_t i = 0; i < layers[k]; ++i) sum += w[i] * values[i];
      next[o] = last ? sum : maths::tanh(sum);
      w += layers[k] + 1;
    }
    values.swap(next);
  }
  std::copy_n(values.begin(), out.size(), out.begin());
}

}  // namespace microswarm::navigation
