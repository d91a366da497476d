// SPDX-License-Identifier: Apache-2.0
#include "microswarm/swarm/robots/step_lanes.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>

#include "microswarm/swarm/robots/contact_moves.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "microswarm/swarm/robots/step_lanes.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h.
#include <hwy/cache_control.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace microswarm {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// One face per lane, or one face in all lanes.
template <class V>
struct FaceLanes {
  V middle_x, middle_y, normal_x, normal_y, half_length;
};

// Vectorised time_to_contact, one face or robot per lane. Products and sums are not fused, to give
// the same bits.
template <class D, class V>
HWY_INLINE V times_to_contact(D d, const FaceLanes<V>& face, V x, V y, V move_x, V move_y,
                              V guard) {
  const V never = hn::Set(d, 2.0f);
  const V zero = hn::Zero(d);
  const V dx = hn::Sub(x, face.middle_x);
  const V dy = hn::Sub(y, face.middle_y);
  const V away = hn::Add(hn::Mul(dx, face.normal_x), hn::Mul(dy, face.normal_y));
  const V v = hn::Add(hn::Mul(move_x, face.normal_x), hn::Mul(move_y, face.normal_y));
  const auto too_near = hn::Lt(away, guard);
  const V leaving = hn::IfThenElseZero(too_near, hn::Mul(guard, hn::Set(d, 0.125f)));
  const auto near =
      hn::And(hn::And(hn::Lt(v, leaving), hn::Lt(hn::Add(away, v), hn::Add(guard, leaving))),
              hn::Ge(away, hn::Neg(guard)));
  if (hn::AllFalse(d, near)) return never;
  const V towards = hn::Min(v, hn::Set(d, -std::numeric_limits<float>::min()));
  const V hit = hn::Max(zero, hn::Div(hn::Sub(guard, away), towards));
  const V sideways = hn::Sub(hn::Mul(move_y, face.normal_x), hn::Mul(move_x, face.normal_y));
  const V along = hn::Add(hn::Sub(hn::Mul(dy, face.normal_x), hn::Mul(dx, face.normal_y)),
                          hn::Mul(hit, sideways));
  const auto meets = hn::And(near, hn::Le(hn::Abs(along), hn::Add(face.half_length, guard)));
  const V standoff = hn::Mul(hn::Set(d, 2.0f), guard);
  const V time = hn::Max(zero, hn::Div(hn::Sub(standoff, away), towards));
  return hn::IfThenElse(meets, hn::IfThenZeroElse(too_near, time), never);
}

/// Calls visit(pack, k, time) for the faces near one robot, one face per lane; `time` belongs to
/// the faces from index k in the pack.
template <class D, class Visit>
HWY_INLINE void for_each_near(D d, const WallFaces& faces, std::span<const FacePack> packs,
                              PointF p, PointF move, Visit&& visit) {
  using V = hn::Vec<D>;
  const std::size_t lanes = hn::Lanes(d);
  const V guard = hn::Set(d, faces.guard());
  const V x = hn::Set(d, p.x), y = hn::Set(d, p.y);
  const V move_x = hn::Set(d, move.x), move_y = hn::Set(d, move.y);
  for (const FacePack& pack : packs) {
    for (std::size_t k = 0; k < FacePack::size; k += lanes) {
      const FaceLanes<V> face{
          hn::Load(d, pack.middle_x.data() + k), hn::Load(d, pack.middle_y.data() + k),
          hn::Load(d, pack.normal_x.data() + k), hn::Load(d, pack.normal_y.data() + k),
          hn::Load(d, pack.half_length.data() + k)};
      visit(pack, k, times_to_contact(d, face, x, y, move_x, move_y, guard));
    }
  }
}

using PackTag = hn::CappedTag<float, FacePack::size>;

/// First contact of one robot with the faces near it.
class NearContact {
 public:
  explicit NearContact(const WallFaces& faces) : faces_(&faces) {}

  FaceContact operator()(PointF p, PointF move) const {
    const PackTag d;
    FaceContact first;
    for_each_near(
        d, *faces_, faces_->near(p), p, move, [&](const FacePack& pack, std::size_t k, auto time) {
          const auto sooner = hn::Lt(time, hn::Set(d, first.time));
          if (hn::AllFalse(d, sooner)) return;
          const auto least = hn::MinOfLanes(d, time);
          const auto lane = static_cast<std::size_t>(hn::FindFirstTrue(d, hn::Eq(time, least)));
          first =
              FaceContact{hn::GetLane(least), {pack.normal_x[k + lane], pack.normal_y[k + lane]}};
        });
    return first;
  }

 private:
  const WallFaces* faces_;
};

/// Time of the first contact only; more than 1 if the move is free.
HWY_INLINE float near_time(const WallFaces& faces, std::span<const FacePack> packs, PointF p,
                           PointF move) {
  const PackTag d;
  auto first = hn::Set(d, 2.0f);
  for_each_near(d, faces, packs, p, move,
                [&](const FacePack&, std::size_t, auto time) { first = hn::Min(first, time); });
  return hn::GetLane(hn::MinOfLanes(d, first));
}

/// Times of the first contact of `lanes` robots with any face.
template <class D, class V>
HWY_INLINE V first_of_all(D d, const WallFaces& faces, PointF move, V x, V y) {
  const V guard = hn::Set(d, faces.guard());
  const V move_x = hn::Set(d, move.x), move_y = hn::Set(d, move.y);
  const float leaving = faces.guard() / 8;
  V first = hn::Set(d, 2.0f);
  for (const WallFace& face : faces.all()) {
    if (!(move.x * face.normal.x + move.y * face.normal.y < leaving)) continue;
    const FaceLanes<V> same{hn::Set(d, face.middle.x), hn::Set(d, face.middle.y),
                            hn::Set(d, face.normal.x), hn::Set(d, face.normal.y),
                            hn::Set(d, face.half_length)};
    first = hn::Min(first, times_to_contact(d, same, x, y, move_x, move_y, guard));
  }
  return first;
}

/// Moves the first robots, as many as fill whole vectors; returns their number.
std::size_t step_by_robots(const WallFaces& faces, PointF move, ContactRule rule,
                           float* HWY_RESTRICT xs, float* HWY_RESTRICT ys, std::size_t count) {
  const hn::ScalableTag<float> d;
  using V = hn::Vec<decltype(d)>;
  const std::size_t lanes = hn::Lanes(d);
  const ContactMoves moves(faces.reach(), faces.guard(), NearContact(faces));
  const V one = hn::Set(d, 1.0f), zero = hn::Zero(d);
  const V move_x = hn::Set(d, move.x), move_y = hn::Set(d, move.y);
  std::size_t i = 0;
  for (; i + lanes <= count; i += lanes) {
    const V x = hn::LoadU(d, xs + i), y = hn::LoadU(d, ys + i);
    const V time = first_of_all(d, faces, move, x, y);
    const auto met = hn::Le(time, one);
    const V share = hn::IfThenElse(met, rule == ContactRule::stop ? time : zero, one);
    const V end_x = hn::Add(x, hn::Mul(share, move_x));
    const V end_y = hn::Add(y, hn::Mul(share, move_y));
    hn::StoreU(end_x, d, xs + i);
    hn::StoreU(end_y, d, ys + i);
    if (rule != ContactRule::slide || hn::AllFalse(d, met)) continue;
    HWY_ALIGN float times[HWY_MAX_BYTES / sizeof(float)];
    hn::Store(time, d, times);
    for (std::size_t k = 0; k < lanes; ++k) {
      if (!(times[k] <= 1)) continue;
      const PointF end = moves.slid({xs[i + k], ys[i + k]}, move);
      xs[i + k] = end.x;
      ys[i + k] = end.y;
    }
  }
  return i;
}

void step_here(const WallFaces& faces, PointF move, ContactRule rule, float* HWY_RESTRICT x,
               float* HWY_RESTRICT y, std::size_t count) {
  constexpr std::size_t few_faces = 24;
  constexpr std::size_t block = 32;
  const bool in_one_go = move.x * move.x + move.y * move.y <= faces.reach() * faces.reach();
  std::size_t i = 0;
  if (in_one_go && faces.all().size() <= few_faces)
    i = step_by_robots(faces, move, rule, x, y, count);
  const ContactMoves moves(faces.reach(), faces.guard(), NearContact(faces));
  if (!in_one_go) {
    for (; i < count; ++i) {
      const PointF end = moves.moved({x[i], y[i]}, move, rule);
      x[i] = end.x;
      y[i] = end.y;
    }
  }
  const float share_of_time = rule == ContactRule::stop ? 1.0f : 0.0f;
  std::array<std::span<const FacePack>, block> near;
  while (i < count) {
    const std::size_t many = std::min(block, count - i);
    for (std::size_t k = 0; k < many; ++k) {
      near[k] = faces.near({x[i + k], y[i + k]});
      hwy::Prefetch(near[k].data());
      hwy::Prefetch(reinterpret_cast<const std::byte*>(near[k].data()) + 64);
      hwy::Prefetch(reinterpret_cast<const std::byte*>(near[k].data()) + 128);
    }
    for (std::size_t k = 0; k < many; ++k, ++i) {
      const PointF p{x[i], y[i]};
      const float time = near_time(faces, near[k], p, move);
      if (rule == ContactRule::slide && time <= 1) {
        const PointF end = moves.slid(p, move);
        x[i] = end.x;
        y[i] = end.y;
        continue;
      }
      const float share = time <= 1 ? share_of_time * time : 1.0f;  // branchless: unpredictable
      x[i] = p.x + share * move.x;
      y[i] = p.y + share * move.y;
    }
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace microswarm
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace microswarm {

HWY_EXPORT(step_here);

void step_lanes(const WallFaces& faces, PointF move, ContactRule rule, std::span<float> x,
                std::span<float> y) {
  HWY_DYNAMIC_DISPATCH(step_here)(faces, move, rule, x.data(), y.data(), x.size());
}

}  // namespace microswarm
#endif
