// SPDX-License-Identifier: Apache-2.0
#include "microswarm/world/map/wall_candidates.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "microswarm/core/maths/infinity.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "microswarm/world/map/wall_candidates.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h.
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace microswarm {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// Vectors from p to the nearest points of the cores.
template <class V>
struct CoreOffsets {
  V x, y;
  HWY_INLINE V squares() const { return hn::Add(hn::Mul(x, x), hn::Mul(y, y)); }
};

template <class D>
HWY_INLINE CoreOffsets<hn::Vec<D>> to_cores(D d, const WallCandidates::View& c, std::size_t i,
                                            Vec2 p) {
  const auto dx = hn::Sub(hn::LoadU(d, c.x + i), hn::Set(d, p.x));
  const auto dy = hn::Sub(hn::LoadU(d, c.y + i), hn::Set(d, p.y));
  const auto u = hn::LoadU(d, c.u + i);
  const auto v = hn::LoadU(d, c.v + i);
  const auto along =
      hn::Mul(hn::Add(hn::Mul(dx, u), hn::Mul(dy, v)), hn::LoadU(d, c.per_length2 + i));
  const auto t = hn::Min(hn::Max(hn::Neg(along), hn::Zero(d)), hn::Set(d, 1.0));
  return {hn::Add(dx, hn::Mul(t, u)), hn::Add(dy, hn::Mul(t, v))};
}

/// Measures the first `count`; returns the least measure.
template <bool discs, class D>
HWY_INLINE double measure_kind(D d, const WallCandidates::View& c, std::size_t count, Vec2 p) {
  auto least = hn::Set(d, infinity);
  for (std::size_t i = 0; i < count; i += hn::Lanes(d)) {
    auto measure = to_cores(d, c, i, p).squares();
    if (discs) measure = hn::Sub(hn::Sqrt(measure), hn::LoadU(d, c.radius + i));
    measure = hn::IfThenElse(hn::FirstN(d, count - i), measure, hn::Set(d, infinity));
    hn::StoreU(measure, d, c.measure + i);
    least = hn::Min(least, measure);
  }
  return hn::GetLane(hn::MinOfLanes(d, least));
}

/// Which candidates can be nearest in a far block: the bound of FieldPainter on the difference of
/// two distances.
template <bool discs, class D>
HWY_INLINE auto far_rivals(D d, const WallCandidates::View& c, std::size_t i, Vec2 p,
                           const WallCandidates::Bound& bound) {
  auto to = to_cores(d, c, i, p);
  auto distance = hn::LoadU(d, c.measure + i);
  if (discs) {
    const auto radius = hn::LoadU(d, c.radius + i);
    const auto outside = hn::IfThenElseZero(hn::Gt(distance, hn::Zero(d)),
                                            hn::Div(distance, hn::Add(distance, radius)));
    to = {hn::Mul(outside, to.x), hn::Mul(outside, to.y)};
  } else {
    distance = hn::Sqrt(distance);
  }
  const auto gap = hn::Sub(distance, hn::Set(d, bound.nearest));
  to = {hn::Sub(to.x, hn::Set(d, bound.towards.x)), hn::Sub(to.y, hn::Set(d, bound.towards.y))};
  const auto apart = hn::Sqrt(to.squares());
  const auto most =
      hn::Mul(hn::Set(d, bound.half * (1 + 1e-9)), hn::Add(apart, hn::Set(d, 2 * bound.half)));
  return hn::Or(hn::Le(gap, hn::Zero(d)),
                hn::Le(hn::Mul(gap, hn::Set(d, bound.nearest - bound.half)), most));
}

HWY_INLINE void copy_one(const WallCandidates::View& from, std::size_t i,
                         const WallCandidates::View& to, std::size_t k) {
  to.x[k] = from.x[i];
  to.y[k] = from.y[i];
  to.u[k] = from.u[i];
  to.v[k] = from.v[i];
  to.per_length2[k] = from.per_length2[i];
  to.radius[k] = from.radius[i];
  to.wall[k] = from.wall[i];
}

/// Copies the rivals among the first `count` to `out`, which may be behind them; returns how many.
template <bool discs, class D>
HWY_INLINE std::size_t copy_kind(D d, const WallCandidates::View& c, std::size_t count, Vec2 p,
                                 const WallCandidates::Bound& bound,
                                 const WallCandidates::View& out) {
  const double reach = bound.nearest + 2 * bound.half;
  const auto limit = hn::Set(d, discs ? reach : reach < 0 ? -1 : reach * reach);
  std::size_t copied = 0;
  for (std::size_t i = 0; i < count; i += hn::Lanes(d)) {
    auto rivals = hn::And(hn::Le(hn::LoadU(d, c.measure + i), limit), hn::FirstN(d, count - i));
    if (bound.is_far()) rivals = hn::And(rivals, far_rivals<discs>(d, c, i, p, bound));
    std::uint8_t bits[8];
    hn::StoreMaskBits(d, rivals, bits);
    for (unsigned left = bits[0]; left != 0; left &= left - 1)
      copy_one(c, i + static_cast<std::size_t>(std::countr_zero(left)), out, copied++);
  }
  return copied;
}

/// Short vectors are faster for a few candidates.
template <class Ask>
HWY_INLINE auto with_lanes(std::size_t count, Ask&& ask) {
  return count > 2 ? ask(hn::CappedTag<double, 8>()) : ask(hn::CappedTag<double, 2>());
}

double measure_here(const WallCandidates::View& c, std::size_t count, Vec2 p, bool discs) {
  return with_lanes(count, [&](auto d) HWY_ATTR {
    return discs ? measure_kind<true>(d, c, count, p) : measure_kind<false>(d, c, count, p);
  });
}

std::size_t copy_rivals_here(const WallCandidates::View& c, std::size_t count, Vec2 p, bool discs,
                             const WallCandidates::Bound& bound, const WallCandidates::View& out) {
  return with_lanes(count, [&](auto d) HWY_ATTR {
    return discs ? copy_kind<true>(d, c, count, p, bound, out)
                 : copy_kind<false>(d, c, count, p, bound, out);
  });
}

}  // namespace HWY_NAMESPACE
}  // namespace microswarm
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace microswarm {

HWY_EXPORT(measure_here);
HWY_EXPORT(copy_rivals_here);

namespace {

/// Vectors may reach this far beyond the last candidate.
constexpr std::size_t max_lanes = 8;

}  // namespace

void WallCandidates::reserve(std::size_t n) {
  if (n + max_lanes <= wall_.size()) return;
  const std::size_t more = 2 * n + max_lanes;
  for (auto* values : {&x_, &y_, &u_, &v_, &per_length2_, &radius_, &measure_})
    values->resize(more);
  wall_.resize(more);
}

WallCandidates::View WallCandidates::view(std::size_t first) {
  return {x_.data() + first,       y_.data() + first,           u_.data() + first,
          v_.data() + first,       per_length2_.data() + first, radius_.data() + first,
          measure_.data() + first, wall_.data() + first};
}

void WallCandidates::push(const Segment& core, double radius, std::uint32_t wall) {
  reserve(size_ + 1);
  const Vec2 along = kind_ == Kind::edges ? core.b - core.a : Vec2{};
  const double length2 = squared_norm(along);
  x_[size_] = core.a.x;
  y_[size_] = core.a.y;
  u_[size_] = along.x;
  v_[size_] = along.y;
  per_length2_[size_] = length2 > 0 ? 1 / length2 : 0;
  radius_[size_] = radius;
  wall_[size_++] = wall;
}

double WallCandidates::measure(Vec2 p, std::size_t first) {
  measured_from_ = p;
  first_measured_ = first;
  const std::size_t count = size_ - first;
  if (count == 0) return nearest_ = infinity;
  min_measure_ = HWY_DYNAMIC_DISPATCH(measure_here)(view(first), count, p, kind_ == Kind::discs);
  return nearest_ = kind_ == Kind::discs ? min_measure_ : std::sqrt(min_measure_);
}

WallCandidates::Bound WallCandidates::bound(double half) const {
  Bound bound{half, nearest_, {}};
  if (bound.is_far()) bound.towards = towards_nearest();
  return bound;
}

/// Zero in a disc.
Vec2 WallCandidates::towards_nearest() const {
  if (size_ == first_measured_) return {};
  std::size_t i = first_measured_;
  while (i + 1 < size_ && measure_[i] != min_measure_) ++i;
  const Vec2 offset = Vec2{x_[i], y_[i]} - measured_from_;
  if (kind_ == Kind::edges) {
    const Vec2 along{u_[i], v_[i]};
    return offset + std::clamp(-dot(offset, along) * per_length2_[i], 0.0, 1.0) * along;
  }
  return min_measure_ > 0 ? min_measure_ / (min_measure_ + radius_[i]) * offset : Vec2{};
}

void WallCandidates::push_rivals(const Bound& bound) {
  const std::size_t count = size_ - first_measured_;
  if (count == 0) return;
  reserve(size_ + count);
  size_ += HWY_DYNAMIC_DISPATCH(copy_rivals_here)(view(first_measured_), count, measured_from_,
                                                  kind_ == Kind::discs, bound, view(size_));
}

}  // namespace microswarm
#endif
