// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace microswarm {

/// Purpose of a random stream. Streams of different purposes never share numbers, whatever the
/// seed.
enum class Purpose : std::uint32_t {
  planner = 1,
  plant,
  sensor,
  scene,
  start_goal,
  test,
  learning,
  obstacle_sensor
};

/// Counter-based random stream (Philox4x32-10 of Random123), keyed by (seed, purpose, trial). The
/// same key gives the same numbers on any thread, rank and build; streams of different keys do not
/// overlap. A copy continues independently from the same position.
class Rng {
 public:
  Rng(std::uint64_t seed, Purpose purpose, std::uint32_t trial = 0);

  /// Next 64 random bits.
  std::uint64_t bits() {
    if (next_ == block_.size()) refill();
    return block_[next_++];
  }
  /// Uniform in [0, 1).
  double uniform() { return static_cast<double>(bits() >> 11) * 0x1p-53; }
  /// Uniform in [lo, hi).
  double uniform(double lo, double hi) { return lo + (hi - lo) * uniform(); }
  /// Uniform integer in [0, n), always from 64 bits; the bias of a value is below 2^-64. n must not
  /// be 0.
  std::uint64_t below(std::uint64_t n);
  /// Standard normal (Box–Muller; two uniforms a call, so that the stream position is predictable).
  double normal();

 private:
  void refill();

  std::array<std::uint32_t, 2> key_;
  std::array<std::uint32_t, 4> counter_;
  std::array<std::uint64_t, 8> block_{};
  std::size_t next_ = 8;
};

}  // namespace microswarm
