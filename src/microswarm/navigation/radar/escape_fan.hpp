// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
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

/// Gap that a way must keep: what grows with time, or what does not, whichever is more.
struct LeastGap {
  double start = 0;  ///< [µm]
  double rate = 0;   ///< [µm/s]
  double floor = 0;  ///< [µm]
  double at(double t) const { return std::max(start + rate * t, floor); }
};

/// Ways out that differ in one velocity only. They are screened together, body by body.
class EscapeFan {
 public:
  /// All ways of a fan: each of its velocities is the second of `common`, or the first, in place of
  /// the one there, which is 0.
  struct Ways {
    EscapeWay common;
    bool first_varies = false;
    EscapeWay operator[](Vec2 velocity) const {
      return first_varies ? EscapeWay{velocity, common.until, common.second}
                          : EscapeWay{common.first, common.until, velocity};
    }
    /// Time at the velocity that varies, of the first `t` seconds [s].
    double varied_for(double t) const {
      return first_varies ? std::min(t, common.until) : std::max(0.0, t - common.until);
    }
  };
  /// Where the ways are at one time, relative to a body.
  struct Places {
    const double* x;  ///< of the velocities [µm/s]
    const double* y;
    std::size_t count;
    double after;      ///< time at these [s]
    Vec2 shift;        ///< displacement at the other velocity [µm]
    Vec2 start, body;  ///< [µm]
    double off_x(std::size_t k) const { return start.x + (shift.x + after * x[k]) - body.x; }
    double off_y(std::size_t k) const { return start.y + (shift.y + after * y[k]) - body.y; }
  };

  /// None of `velocities` exceeds `speed` [µm/s].
  EscapeFan(std::vector<Vec2> velocities, double speed);

  std::span<const Vec2> velocities() const { return velocities_; }
  /// Whether, after `begin` till `until`, at least `count` of the velocities are free of contact.
  bool has_free(Foresight& seen, Vec2 begin, double until, int count);
  /// Whether for no beginning within `spread` [µm/s] of `begin` has_free() holds: one look at all
  /// of them, which says false where it is not sure.
  bool excludes(Foresight& seen, Vec2 begin, double spread, double until, int count);
  /// Whether some of the ways may keep these gaps to convex bodies at all of the instants:
  /// is_left() tells which.
  bool may_keep(const Foresight& seen, const Ways& ways,
                std::span<const Foresight::Instant> instants, const LeastGap& least);
  bool is_left(std::size_t velocity) const { return blocked_[velocity] == 0; }

 private:
  /// Gap to be kept [µm].
  struct Demand {
    double gap = 0;
    Foresight::Error error = Foresight::Error::none;
  };

  template <class GapAt>
  bool screen(const Foresight& seen, const Ways& ways, std::span<const Foresight::Instant> instants,
              Foresight::Error error, GapAt&& gap_at, std::int64_t count);
  std::int64_t meet(const Foresight& seen, const Foresight::Near& body, const Ways& ways, double t,
                    const Demand& demand);
  std::int64_t settle(const Places& at, const Foresight::Near& body, const Demand& demand);

  std::vector<Vec2> velocities_;
  double speed_;
  std::vector<double> x_, y_;          ///< of velocities_
  std::vector<std::int64_t> blocked_;  ///< 0 or 1, by velocity
  std::vector<std::int64_t> doubted_;
  std::vector<std::size_t> in_doubt_;              ///< numbers of velocities
  std::vector<double> off_x_, off_y_, distances_;  ///< of those in doubt [µm]
  std::size_t last_ = 0;                           ///< which of the velocities was free last time
};

}  // namespace microswarm
