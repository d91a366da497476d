// SPDX-License-Identifier: Apache-2.0
#include "microswarm/core/maths/rng.hpp"

#include <Random123/philox.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

#include "microswarm/core/maths/maths.hpp"

namespace microswarm {

// The seed is Philox's key. Purpose and trial are the upper half of its counter, the block number
// the lower half. Philox permutes the counters under each key, so streams of one seed cannot
// overlap.
Rng::Rng(std::uint64_t seed, Purpose purpose, std::uint32_t trial)
    : key_{static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32)},
      counter_{0, 0, trial, static_cast<std::uint32_t>(purpose)} {}

/// Makes `max_ahead` numbers more; fewer than that may be left.
void Rng::refill() {
  std::copy(numbers_.begin() + next_, numbers_.begin() + end_, numbers_.begin());
  end_ -= next_;
  next_ = 0;
  const philox4x32_key_t key{{key_[0], key_[1]}};
  for (const std::size_t last = end_ + max_ahead; end_ < last; end_ += 2) {
    const philox4x32_ctr_t counter{{counter_[0], counter_[1], counter_[2], counter_[3]}};
    const philox4x32_ctr_t r = philox4x32(counter, key);
    numbers_[end_] = r.v[0] | static_cast<std::uint64_t>(r.v[1]) << 32;
    numbers_[end_ + 1] = r.v[2] | static_cast<std::uint64_t>(r.v[3]) << 32;
    if (++counter_[0] == 0) ++counter_[1];
  }
}

std::uint64_t Rng::below(std::uint64_t n) {
  assert(n > 0);
  __extension__ using Wide = unsigned __int128;
  return static_cast<std::uint64_t>(static_cast<Wide>(bits()) * n >> 64);
}

double Rng::normal() {
  const double u = 1 - uniform();  // in (0, 1], so the logarithm is finite
  const double v = uniform();
  return std::sqrt(-2 * maths::log(u)) * maths::cos(2 * std::numbers::pi * v);
}

}  // namespace microswarm
