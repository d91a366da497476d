// SPDX-License-Identifier: Apache-2.0
#include "tests/learning/dlib_network.hpp"

#include <dlib/test_for_odr_violations.h>
#undef DLIB_USE_BLAS
#undef DLIB_USE_LAPACK
#include <dlib/dnn.h>

namespace microswarm::test {
namespace {

using Net =
    dlib::fc<2, dlib::htan<dlib::fc<4, dlib::htan<dlib::fc<5, dlib::input<dlib::matrix<float>>>>>>>;

/// dlib keeps a row for each input, then one with the biases.
template <class Layer>
void set_weights(Layer& layer, const double* w, std::size_t ins, std::size_t outs) {
  float* to = layer.layer_details().get_layer_params().host();
  for (std::size_t o = 0; o < outs; ++o)
    for (std::size_t i = 0; i <= ins; ++i)
      to[i * outs + o] = static_cast<float>(w[o * (ins + 1) + i]);
}

}  // namespace

std::array<double, 2> dlib_answer(const navigation::MultilayerPerceptron& network,
                                  std::span<const double> in) {
  dlib::matrix<float> row(static_cast<long>(in.size()), 1);
  std::copy(in.begin(), in.end(), row.begin());
  Net net;
  dlib::resizable_tensor x;
  net.to_tensor(&row, &row + 1, x);
  net.forward(x);  // makes the weights
  const double* w = network.weights.data();
  set_weights(dlib::layer<4>(net), w, 6, 5);
  set_weights(dlib::layer<2>(net), w + 7 * 5, 5, 4);
  set_weights(dlib::layer<0>(net), w + 7 * 5 + 6 * 4, 4, 2);
  const dlib::tensor& answer = net.forward(x);
  return {answer.host()[0], answer.host()[1]};
}

}  // namespace microswarm::test
