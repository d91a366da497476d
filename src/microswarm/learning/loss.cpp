// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>

#include "microswarm/core/execution/parallel.hpp"
#include "microswarm/core/maths/maths.hpp"
#include "microswarm/learning/fit.hpp"

namespace microswarm::learning {
namespace {

constexpr std::size_t lanes = 32;  // examples processed in parallel
constexpr std::size_t per_shard = 64 * lanes;
using Lanes = std::array<double, lanes>;
using Layer = std::vector<Lanes>;  // one entry per unit

/// Dot product, in four independent partial sums.
double dot(const Lanes& a, const Lanes& b) {
  std::array<double, 4> sum{};
  for (std::size_t l = 0; l < lanes; l += 4)
    for (std::size_t p = 0; p < 4; ++p) sum[p] += a[l + p] * b[l + p];
  return (sum[0] + sum[1]) + (sum[2] + sum[3]);
}

/// Loss and gradient of a subset of examples, `lanes` at a time.
class Shard {
 public:
  explicit Shard(const navigation::MultilayerPerceptron& network)
      : gradient(network.weights.size()), net_(network), values_(net_.layers.size()) {
    for (std::size_t k = 0; k < values_.size(); ++k) values_[k].resize(net_.layers[k]);
    errors_ = values_;
  }

  void add(const Examples& examples, std::size_t first, std::size_t count) {
    load(examples, first, count);
    forward();
    Layer& error = errors_.back();
    for (std::size_t o = 0; o < examples.out; ++o)
      for (std::size_t l = 0; l < lanes; ++l) {
        const double off =
            l < count ? values_.back()[o][l] - examples.answers[(first + l) * examples.out + o] : 0;
        loss += off * off;
        error[o][l] = 2 * off;
      }
    backward();
  }

  double loss = 0;
  std::vector<double> gradient;

 private:
  void load(const Examples& examples, std::size_t first, std::size_t count) {
    for (std::size_t i = 0; i < examples.in; ++i)
      for (std::size_t l = 0; l < lanes; ++l)
        values_[0][i][l] = l < count ? examples.inputs[(first + l) * examples.in + i] : 0;
  }

  void forward() {
    const double* w = net_.weights.data();
    for (std::size_t k = 0; k + 1 < values_.size(); ++k) {
      const bool last = k + 2 == values_.size();
      for (Lanes& out : values_[k + 1]) {
        out.fill(w[values_[k].size()]);
        for (const Lanes& in : values_[k]) {
          for (std::size_t l = 0; l < lanes; ++l) out[l] += *w * in[l];
          ++w;
        }
        ++w;
        if (!last)
          for (double& v : out) v = maths::tanh(v);
      }
    }
  }

  void backward() {
    std::size_t end = net_.weights.size();
    for (std::size_t k = values_.size() - 1; k-- > 0;) {
      const std::size_t ins = values_[k].size(), outs = values_[k + 1].size();
      const std::size_t begin = end - outs * (ins + 1);
      for (Lanes& e : errors_[k]) e.fill(0);
      for (std::size_t o = 0; o < outs; ++o) {
        const std::size_t row = begin + o * (ins + 1);
        const Lanes& error = errors_[k + 1][o];
        for (std::size_t i = 0; i < ins; ++i) {
          gradient[row + i] += dot(error, values_[k][i]);
          const double w = net_.weights[row + i];
          for (std::size_t l = 0; l < lanes; ++l) errors_[k][i][l] += w * error[l];
        }
        for (const double e : error) gradient[row + ins] += e;
      }
      if (k > 0)  // through tanh
        for (std::size_t i = 0; i < ins; ++i)
          for (std::size_t l = 0; l < lanes; ++l)
            errors_[k][i][l] *= 1 - values_[k][i][l] * values_[k][i][l];
      end = begin;
    }
  }

  const navigation::MultilayerPerceptron& net_;
  std::vector<Layer> values_;
  std::vector<Layer> errors_;  // derivatives of the loss with respect to the values
};

}  // namespace

double loss_with_gradient(const navigation::MultilayerPerceptron& network, const Examples& examples,
                          std::vector<double>& gradient, int jobs) {
  const std::size_t count = examples.count();
  std::vector<Shard> shards((count + per_shard - 1) / per_shard, Shard(network));
  for_each_index(shards.size(), jobs, [&](std::size_t s) {
    const std::size_t end = std::min(count, (s + 1) * per_shard);
    for (std::size_t i = s * per_shard; i < end; i += lanes)
      shards[s].add(examples, i, std::min(lanes, end - i));
  });
  gradient.assign(network.weights.size(), 0);
  double loss = 0;
  for (const Shard& shard : shards) {
    loss += shard.loss;
    for (std::size_t w = 0; w < gradient.size(); ++w) gradient[w] += shard.gradient[w];
  }
  const double n = std::max<double>(1, static_cast<double>(count));
  for (double& g : gradient) g /= n;
  return loss / n;
}

}  // namespace microswarm::learning
