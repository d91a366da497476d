// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <span>

namespace microswarm {

/// Purpose of a random stream. Streams of different purposes never share numbers, for any seed.
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
    if (next_ == end_) refill();
    return numbers_[next_++];
  }
  /// The bits that the next `count` <= max_ahead calls of `bits` will give, without drawing them.
  std::span<const std::uint64_t> ahead(std::size_t count) {
    assert(count <= max_ahead);
    if (end_ - next_ < count) refill();
    return {numbers_.data() + next_, count};
  }
  static constexpr std::size_t max_ahead = 8;
  /// Draws `count` numbers that were looked at.
  void skip(std::size_t count) {
    assert(count <= end_ - next_);
    next_ += count;
  }
  /// Uniform in [0, 1).
  double uniform() { return to_uniform(bits()); }
  static double to_uniform(std::uint64_t bits) { return static_cast<double>(bits >> 11) * 0x1p-53; }
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
  std::array<std::uint64_t, 2 * max_ahead> numbers_{};  ///< made and not drawn: [next_, end_)
  std::size_t next_ = 0;
  std::size_t end_ = 0;
};

}  // namespace microswarm
