// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "microswarm/navigation/radar/foresight.hpp"

namespace microswarm {

/// Whether a swarm keeps the required gaps on the way at these instants; `before` [s] is the one
/// before the first of them.
bool is_free(const Foresight& seen, const EscapeWay& way,
             std::span<const Foresight::Instant> instants, double before);

/// Ways out after one beginning: at each of some velocities straight on. They are screened
/// together, body by body.
class EscapeFan {
 public:
  /// None of `velocities` exceeds `speed` [µm/s].
  EscapeFan(std::vector<Vec2> velocities, double speed);

  std::span<const Vec2> velocities() const { return velocities_; }
  /// Whether, after `begin` till `until`, at least `count` of the velocities are free of contact.
  bool has_free(Foresight& seen, Vec2 begin, double until, int count);

 private:
  bool screen(const Foresight& seen, const EscapeWay& begin,
              std::span<const Foresight::Instant> instants, std::int64_t count);
  std::int64_t meet(const Foresight& seen, const Foresight::Near& body, const EscapeWay& begin,
                    const Foresight::Instant& at);

  std::vector<Vec2> velocities_;
  double speed_;
  std::vector<double> x_, y_;          ///< of velocities_
  std::vector<std::int64_t> blocked_;  ///< 0 or 1, by velocity
  std::vector<std::int64_t> doubted_;
  std::size_t last_ = 0;  ///< which of the velocities was free last time
};

}  // namespace microswarm
