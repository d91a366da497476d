// SPDX-License-Identifier: Apache-2.0
#include "microswarm/reproduce/gather/violin.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "microswarm/core/maths/maths.hpp"

namespace microswarm::reproduce {

void add_violin(std::vector<double> values, double x, double half_width, report::Series& series) {
  constexpr int levels = 24;
  if (values.empty()) return;
  std::sort(values.begin(), values.end());
  const double lo = values.front();
  const double hi = values.back();
  const double kernel = std::max(0.5, 0.2 * (hi - lo));
  std::vector<double> density;
  for (int k = 0; k <= levels; ++k) {
    double sum = 0;
    for (const double v : values)
      sum += maths::exp(-0.5 * maths::power((v - (lo + (hi - lo) * k / levels)) / kernel, 2));
    density.push_back(sum);
  }
  const double most = *std::max_element(density.begin(), density.end());
  const auto put = [&](int k, double side) {
    series.x.push_back(x + side * half_width * density[static_cast<std::size_t>(k)] / most);
    series.y.push_back(lo + (hi - lo) * k / levels);
  };
  for (int k = 0; k <= levels; ++k) put(k, -1);
  for (int k = levels; k >= 0; --k) put(k, 1);
  put(0, -1);
  series.x.push_back(x);
  series.y.push_back(std::nan(""));  // interrupts the line
}

}  // namespace microswarm::reproduce
