// SPDX-License-Identifier: Apache-2.0
#include "microswarm/learning/fit.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/learning/dlib_network.hpp"

namespace microswarm::learning {
namespace {

navigation::MultilayerPerceptron random_network(std::vector<std::size_t> layers, Rng& rng) {
  navigation::MultilayerPerceptron network{.layers = std::move(layers), .weights = {}};
  network.weights.resize(navigation::MultilayerPerceptron::weight_count(network.layers));
  for (double& w : network.weights) w = rng.uniform(-1, 1);
  return network;
}

Examples random_examples(std::size_t count, Rng& rng) {
  Examples examples{.in = 3, .out = 2, .inputs = {}, .answers = {}};
  for (std::size_t i = 0; i < count; ++i) {
    const double a = rng.uniform(-1, 1), b = rng.uniform(-1, 1), c = rng.uniform(-1, 1);
    for (const double v : {a, b, c}) examples.inputs.push_back(v);
    for (const double v : {a * b, std::sin(2 * c)}) examples.answers.push_back(v);
  }
  return examples;
}

TEST(MultilayerPerceptron, AnswersAsDlibsLayersDo) {
  Rng rng(1, Purpose::test);
  for (int trial = 0; trial < 20; ++trial) {
    const navigation::MultilayerPerceptron network = random_network({6, 5, 4, 2}, rng);
    std::array<double, 6> in{};
    for (double& v : in) v = rng.uniform(-2, 2);
    std::array<double, 2> ours{};
    network.evaluate(in, ours);
    const auto theirs = test::dlib_answer(network, in);
    for (int o = 0; o < 2; ++o) EXPECT_NEAR(ours[o], theirs[o], 2e-6) << trial;
  }
}

TEST(Loss, IsThatOfTheNetworkOneByOne) {
  Rng rng(2, Purpose::test);
  const navigation::MultilayerPerceptron network = random_network({3, 7, 2}, rng);
  const Examples examples = random_examples(2500, rng);  // more than one shard, a part of lanes
  double sum = 0;
  for (std::size_t i = 0; i < examples.count(); ++i) {
    std::array<double, 2> out{};
    network.evaluate(std::span(examples.inputs).subspan(3 * i, 3), out);
    for (std::size_t o = 0; o < 2; ++o)
      sum += (out[o] - examples.answers[2 * i + o]) * (out[o] - examples.answers[2 * i + o]);
  }
  std::vector<double> gradient;
  EXPECT_NEAR(loss_with_gradient(network, examples, gradient, 1), sum / 2500, 1e-12);
}

TEST(Loss, GradientIsThatOfDifferences) {
  Rng rng(3, Purpose::test);
  navigation::MultilayerPerceptron network = random_network({3, 5, 4, 2}, rng);
  const Examples examples = random_examples(70, rng);
  std::vector<double> gradient, unused;
  loss_with_gradient(network, examples, gradient, 1);
  constexpr double h = 1e-5;
  for (std::size_t w = 0; w < network.weights.size(); ++w) {
    const double kept = network.weights[w];
    network.weights[w] = kept + h;
    const double more = loss_with_gradient(network, examples, unused, 1);
    network.weights[w] = kept - h;
    const double less = loss_with_gradient(network, examples, unused, 1);
    network.weights[w] = kept;
    EXPECT_NEAR(gradient[w], (more - less) / (2 * h), 1e-8) << w;
  }
}

TEST(Fit, FindsAFunctionAndTheSameBitsOnAnyThreads) {
  Rng rng(4, Purpose::test);
  const Examples examples = random_examples(3000, rng);
  const auto fitted = [&](int jobs) {
    Rng weights(5, Purpose::test);
    return fit({3, 8, 8, 2}, examples, {.iterations = 60, .jobs = jobs}, weights);
  };
  const navigation::MultilayerPerceptron one = fitted(1), two = fitted(2);
  EXPECT_EQ(one.weights, two.weights);
  std::vector<double> unused;
  EXPECT_LT(loss_with_gradient(one, examples, unused, 1), 0.01);  // the answers' own is about 0.6
}

TEST(Fit, EndsWhenTold) {
  Rng rng(6, Purpose::test);
  const Examples examples = random_examples(100, rng);
  std::atomic<bool> told = false;
  int rounds = 0;
  const FitOptions options{.iterations = 100'000, .progress = [&](int) { told = ++rounds == 3; }};
  fit({3, 4, 2}, examples, options, rng, Stop(&told));
  EXPECT_EQ(rounds, 3);
}

}  // namespace
}  // namespace microswarm::learning
