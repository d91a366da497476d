// SPDX-License-Identifier: Apache-2.0
#include "microswarm/actuation/drivers/output_check.hpp"

#include <algorithm>
#include <cmath>

#include "microswarm/core/maths/angles.hpp"
#include "microswarm/core/maths/maths.hpp"

namespace microswarm::actuation {
namespace {

constexpr double rounding = 10;  // [per mille] by the device's sine table and integers

/// Upper bound of an output's change when one aim replaces another [per mille].
double change(const CoilAim& from, const CoilAim& to, std::size_t c) {
  const double cosine = to.cosine[c] - from.cosine[c], sine = to.sine[c] - from.sine[c];
  return std::abs(to.constant[c] - from.constant[c]) + std::sqrt(cosine * cosine + sine * sine);
}

}  // namespace

void OutputCheck::begin(const CoilReply& armed) {
  known_ = true;
  last_ = {};
  rest_ = {};
  clock_ = armed.clock;
}

bool OutputCheck::agrees(const CoilAim& aim, const CoilReply& reply) {
  const CoilAim followed = scaled(aim, reply.scale);
  const bool is_scaled = reply.scale != coil_link_unscaled;
  if (reply.aim_sum != check_sum(followed) || is_scaled != (reply.result == CoilResult::limited))
    return false;
  const auto [sine, cosine] = maths::sincos(2 * pi * reply.phase / 65536);
  const double passed = ((reply.clock - clock_) & 0xFFFF) - 1;  // lower bound [ms]
  bool agree = true;
  for (std::size_t c = 0; c < rest_.size(); ++c) {
    const double rest = std::abs(reply.outputs[c] - followed.constant[c] -
                                 followed.cosine[c] * cosine - followed.sine[c] * sine);
    const double most =
        change(last_, followed, c) + std::max(0.0, rest_[c] - reply.slew * std::max(passed, 0.0));
    if (known_ && rest > most + rounding) agree = false;
    rest_[c] = rest + rounding;
  }
  last_ = followed;
  clock_ = reply.clock;
  known_ = true;
  return agree;
}

}  // namespace microswarm::actuation
