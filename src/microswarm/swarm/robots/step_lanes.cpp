// SPDX-License-Identifier: Apache-2.0
#include "microswarm/swarm/robots/step_lanes.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <numeric>

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

using RobotTag = hn::CappedTag<float, 64>;
using PackTag = hn::CappedTag<float, FacePack::size>;

/// Robots that are moved together, one per lane. A wave moves each by a piece, up to its first
/// contact; robots whose move is not finished then stay for the next wave.
struct Block {
  static constexpr std::size_t size = 128;
  template <class T>
  using Lanes = std::array<T, size>;

  std::size_t count;
  alignas(64) Lanes<float> x, y;
  alignas(64) Lanes<float> piece_x, piece_y;
  alignas(64) Lanes<float> time, normal_x, normal_y;  ///< of the piece's first contact
  // Of robots that slide:
  alignas(64) Lanes<std::int32_t> robot;
  alignas(64) Lanes<float> left_x, left_y;    ///< of the move
  alignas(64) Lanes<float> share;             ///< of it that the piece is
  alignas(64) Lanes<float> lean_x, lean_y;    ///< off the wall along which a robot slides
  alignas(64) Lanes<float> contacts, pieces;  ///< so far; at most
};

/// One face per lane, or one face in all lanes.
template <class V>
struct FaceLanes {
  V middle_x, middle_y, normal_x, normal_y, half_length;
};

// Vectorised time_to_contact, one face or robot per lane. Products and sums are not fused, to give
// the same bits.
template <bool may_skip, class D, class V>
HWY_INLINE V times_to_contact(D d, const FaceLanes<V>& face, V x, V y, V move_x, V move_y,
                              V guard) {
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
  if (may_skip && hn::AllFalse(d, near)) return hn::Set(d, 2.0f);
  const V towards = hn::Min(v, hn::Set(d, -std::numeric_limits<float>::min()));
  const V hit = hn::Max(zero, hn::Div(hn::Sub(guard, away), towards));
  const V sideways = hn::Sub(hn::Mul(move_y, face.normal_x), hn::Mul(move_x, face.normal_y));
  const V along = hn::Add(hn::Sub(hn::Mul(dy, face.normal_x), hn::Mul(dx, face.normal_y)),
                          hn::Mul(hit, sideways));
  const auto meets = hn::And(near, hn::Le(hn::Abs(along), hn::Add(face.half_length, guard)));
  const V standoff = hn::Mul(hn::Set(d, 2.0f), guard);
  // Of a robot that is too near the quotient is negative.
  const V time = hn::Max(zero, hn::Div(hn::Sub(standoff, away), towards));
  return hn::IfThenElse(meets, time, hn::Set(d, 2.0f));
}

/// First contacts with any face, the robots in lanes.
template <bool with_normals>
HWY_INLINE void contacts_of_all(const WallFaces& faces, Block& b) {
  const RobotTag d;
  using V = hn::Vec<RobotTag>;
  const V guard = hn::Set(d, faces.guard());
  const V leaving = hn::Mul(guard, hn::Set(d, 0.125f));
  for (std::size_t i = 0; i < b.count; i += hn::Lanes(d)) {
    const V x = hn::Load(d, &b.x[i]), y = hn::Load(d, &b.y[i]);
    const V move_x = hn::Load(d, &b.piece_x[i]), move_y = hn::Load(d, &b.piece_y[i]);
    V time = hn::Set(d, 2.0f), normal_x = hn::Zero(d), normal_y = hn::Zero(d);
    for (const WallFace& face : faces.all()) {
      const FaceLanes<V> same{hn::Set(d, face.middle.x), hn::Set(d, face.middle.y),
                              hn::Set(d, face.normal.x), hn::Set(d, face.normal.y),
                              hn::Set(d, face.half_length)};
      const V v = hn::Add(hn::Mul(move_x, same.normal_x), hn::Mul(move_y, same.normal_y));
      if (hn::AllFalse(d, hn::Lt(v, leaving))) continue;
      const V t = times_to_contact<true>(d, same, x, y, move_x, move_y, guard);
      if (with_normals) {
        const auto sooner = hn::Lt(t, time);
        normal_x = hn::IfThenElse(sooner, same.normal_x, normal_x);
        normal_y = hn::IfThenElse(sooner, same.normal_y, normal_y);
      }
      time = hn::Min(t, time);
    }
    hn::Store(time, d, &b.time[i]);
    if (!with_normals) continue;
    hn::Store(normal_x, d, &b.normal_x[i]);
    hn::Store(normal_y, d, &b.normal_y[i]);
  }
}

/// Robots of a block that are each tested against the faces of one pack.
struct PackTests {
  std::size_t count = 0;
  Block::Lanes<std::uint32_t> robot, pack;
  alignas(64) std::array<float, Block::size * FacePack::size> times;      ///< by test and face
  alignas(64) std::array<float, Block::size * FacePack::size / 2> first;  ///< time of each test
};

/// The times of all tests, the faces of a pack in lanes.
HWY_INLINE void find_times(const FacePack* packs, float guard, const Block& b, PackTests& tests) {
  const PackTag d;
  using V = hn::Vec<PackTag>;
  for (std::size_t t = 0; t < tests.count; ++t) {
    const FacePack& pack = packs[tests.pack[t]];
    const std::size_t i = tests.robot[t];
    const V x = hn::Set(d, b.x[i]), y = hn::Set(d, b.y[i]);
    const V move_x = hn::Set(d, b.piece_x[i]), move_y = hn::Set(d, b.piece_y[i]);
    for (std::size_t k = 0; k < FacePack::size; k += hn::Lanes(d)) {
      const FaceLanes<V> face{
          hn::Load(d, pack.middle_x.data() + k), hn::Load(d, pack.middle_y.data() + k),
          hn::Load(d, pack.normal_x.data() + k), hn::Load(d, pack.normal_y.data() + k),
          hn::Load(d, pack.half_length.data() + k)};
      const V time = times_to_contact<false>(d, face, x, y, move_x, move_y, hn::Set(d, guard));
      hn::Store(time, d, &tests.times[FacePack::size * t + k]);
    }
  }
}

/// The least time of each test: the least of each two times, then of each two of these, and so on,
/// for all tests at once: one test alone would wait for each comparison.
HWY_INLINE void find_first(PackTests& tests) {
  const RobotTag d;
  const float* from = tests.times.data();
  for (std::size_t left = FacePack::size / 2; left > 0; left /= 2) {
    for (std::size_t k = 0; k < left * tests.count; k += hn::Lanes(d)) {
      hn::Vec<RobotTag> even, odd;
      hn::LoadInterleaved2(d, from + 2 * k, even, odd);
      hn::Store(hn::Min(even, odd), d, &tests.first[k]);
    }
    from = tests.first.data();
  }
}

/// Index of the first face of a pack that is met at the time `first`.
HWY_INLINE std::size_t face_met(const float* times, float first) {
  const PackTag d;
  const auto at = [&](std::size_t k) { return hn::Eq(hn::Load(d, times + k), hn::Set(d, first)); };
  std::size_t k = 0;
  while (k + hn::Lanes(d) < FacePack::size && hn::AllFalse(d, at(k))) k += hn::Lanes(d);
  return k + static_cast<std::size_t>(hn::FindKnownFirstTrue(d, at(k)));
}

/// First contacts of the robots with their packs and, unless these are the first of their lists,
/// with those before. Leaves the tests with the packs that follow.
template <bool with_normals, bool are_first>
HWY_INLINE void test_packs(const FacePack* packs, float guard, Block& b, PackTests& tests) {
  find_times(packs, guard, b, tests);
  find_first(tests);
  std::size_t kept = 0;
  for (std::size_t t = 0; t < tests.count; ++t) {
    const FacePack& pack = packs[tests.pack[t]];
    const std::uint32_t i = tests.robot[t];
    const float first = tests.first[t];
    if (are_first || first < b.time[i]) {
      b.time[i] = first;
      if (with_normals) {
        const std::size_t k = face_met(&tests.times[FacePack::size * t], first);
        b.normal_x[i] = pack.normal_x[k];
        b.normal_y[i] = pack.normal_y[k];
      }
    }
    if (pack.following == 0) continue;
    tests.robot[kept] = i;
    tests.pack[kept++] = tests.pack[t] + 1;
  }
  tests.count = kept;
}

/// Places in FaceGrid::lists of the faces near each robot on its piece.
HWY_INLINE void find_lists(const FaceGrid& grid, const Block& b, std::int32_t* found) {
  const RobotTag d;
  const hn::RebindToSigned<RobotTag> di;
  using V = hn::Vec<RobotTag>;
  const V zero = hn::Zero(d);
  const V low_x = hn::Set(d, grid.low.x), low_y = hn::Set(d, grid.low.y);
  const V per_cell = hn::Set(d, grid.per_cell), short_move = hn::Set(d, grid.short_move);
  const V last_column = hn::Set(d, grid.last_column), last_row = hn::Set(d, grid.last_row);
  const auto columns = hn::Set(di, static_cast<std::int32_t>(grid.columns));
  const auto a_cell = hn::Set(di, static_cast<std::int32_t>(FaceGrid::lists_a_cell));
  const auto any = hn::Set(di, static_cast<std::int32_t>(FaceGrid::any_direction));
  const auto add_if = [&](auto yes, std::int32_t share) {
    return hn::IfThenElseZero(hn::RebindMask(di, yes), hn::Set(di, share));
  };
  for (std::size_t i = 0; i < b.count; i += hn::Lanes(d)) {
    const V column = hn::Mul(hn::Sub(hn::Load(d, &b.x[i]), low_x), per_cell);
    const V row = hn::Mul(hn::Sub(hn::Load(d, &b.y[i]), low_y), per_cell);
    const auto in = [&](V v, V last) { return hn::ConvertTo(di, hn::Min(hn::Max(v, zero), last)); };
    const auto cell = hn::Add(hn::Mul(in(row, last_row), columns), in(column, last_column));
    const V move_x = hn::Load(d, &b.piece_x[i]), move_y = hn::Load(d, &b.piece_y[i]);
    const V far_x = hn::Abs(move_x), far_y = hn::Abs(move_y);
    const auto eighth =
        hn::Add(hn::Add(add_if(hn::Lt(move_x, zero), 1), add_if(hn::Lt(move_y, zero), 2)),
                add_if(hn::Gt(far_y, far_x), 4));
    const auto is_short = hn::RebindMask(di, hn::Lt(hn::Max(far_x, far_y), short_move));
    hn::Store(hn::Add(hn::Mul(cell, a_cell), hn::IfThenElse(is_short, any, eighth)), di, found + i);
  }
}

/// First contacts with the faces near each robot.
template <bool with_normals>
HWY_INLINE void contacts_of_near(const WallFaces& faces, Block& b) {
  const FaceGrid& grid = faces.grid();
  alignas(64) Block::Lanes<std::int32_t> list;
  find_lists(grid, b, list.data());
  PackTests tests;
  for (std::size_t i = 0; i < b.count; ++i) {
    const std::uint32_t first = grid.lists()[list[i]];
    tests.robot[tests.count] = static_cast<std::uint32_t>(i);
    tests.pack[tests.count] = first;
    tests.count += first != 0;
    b.time[i] = 2;
    const auto* data = reinterpret_cast<const std::byte*>(grid.packs() + first);
    for (int line = 0; line < 3; ++line) hwy::Prefetch(data + 64 * line);
  }
  test_packs<with_normals, true>(grid.packs(), faces.guard(), b, tests);
  while (tests.count > 0) test_packs<with_normals, false>(grid.packs(), faces.guard(), b, tests);
}

template <bool with_normals>
HWY_INLINE void find_contacts(const WallFaces& faces, Block& b) {
  constexpr std::size_t few_faces = 24;
  faces.all().size() <= few_faces ? contacts_of_all<with_normals>(faces, b)
                                  : contacts_of_near<with_normals>(faces, b);
}

/// Takes `count` robots and their moves into the block.
HWY_INLINE void take(const RobotMoves& moves, std::size_t first, const float* x, const float* y,
                     std::size_t count, Block& b) {
  b.count = count;
  std::copy_n(x, count, b.x.begin());
  std::copy_n(y, count, b.y.begin());
  moves.copy(first, count, b.left_x.data(), b.left_y.data());
  const std::size_t lanes = hn::Lanes(RobotTag());
  for (std::size_t k = count; k % lanes != 0; ++k) b.x[k] = b.y[k] = b.left_x[k] = b.left_y[k] = 0;
}

/// Equal pieces of each move; returns the greatest number of them.
float set_equal_pieces(Block& b, float reach) {
  const RobotTag d;
  using V = hn::Vec<RobotTag>;
  const V one = hn::Set(d, 1.0f);
  V most = one;
  for (std::size_t i = 0; i < b.count; i += hn::Lanes(d)) {
    const V x = hn::Load(d, &b.left_x[i]), y = hn::Load(d, &b.left_y[i]);
    const V far = hn::Sqrt(hn::Add(hn::Mul(x, x), hn::Mul(y, y)));
    const V pieces = hn::Max(one, hn::Ceil(hn::Div(far, hn::Set(d, reach))));
    hn::Store(pieces, d, &b.pieces[i]);
    hn::Store(hn::Div(x, pieces), d, &b.piece_x[i]);
    hn::Store(hn::Div(y, pieces), d, &b.piece_y[i]);
    hn::Store(hn::Zero(d), d, &b.contacts[i]);
    most = hn::Max(most, pieces);
  }
  return hn::GetLane(hn::MaxOfLanes(d, most));
}

/// ContactMoves::moved for the robots of the block, which are at x, y.
void stop_or_reject(const WallFaces& faces, ContactRule rule, Block& b, float* x, float* y) {
  const RobotTag d;
  using V = hn::Vec<RobotTag>;
  const V one = hn::Set(d, 1.0f);
  const float most = set_equal_pieces(b, faces.reach());
  for (float piece = 1; piece <= most; ++piece) {
    find_contacts<false>(faces, b);
    for (std::size_t i = 0; i < b.count; i += hn::Lanes(d)) {
      const V time = hn::Load(d, &b.time[i]), contacts = hn::Load(d, &b.contacts[i]);
      const V at_x = hn::Load(d, &b.x[i]), at_y = hn::Load(d, &b.y[i]);
      const V part = hn::Min(time, one);
      const V next_x = hn::Add(at_x, hn::Mul(part, hn::Load(d, &b.piece_x[i])));
      const V next_y = hn::Add(at_y, hn::Mul(part, hn::Load(d, &b.piece_y[i])));
      const auto goes_on = hn::And(hn::Eq(contacts, hn::Zero(d)),
                                   hn::Le(hn::Set(d, piece), hn::Load(d, &b.pieces[i])));
      hn::Store(hn::IfThenElse(goes_on, next_x, at_x), d, &b.x[i]);
      hn::Store(hn::IfThenElse(goes_on, next_y, at_y), d, &b.y[i]);
      hn::Store(hn::IfThenElse(hn::And(goes_on, hn::Le(time, one)), one, contacts), d,
                &b.contacts[i]);
    }
  }
  for (std::size_t i = 0; i < b.count; ++i) {
    const bool stays = rule == ContactRule::reject && b.contacts[i] > 0;
    x[i] = stays ? x[i] : b.x[i];
    y[i] = stays ? y[i] : b.y[i];
  }
}

/// The next pieces of ContactMoves::slid, and in the first wave their maximum number.
void set_pieces(Block& b, float reach, bool is_first) {
  const RobotTag d;
  using V = hn::Vec<RobotTag>;
  const V r = hn::Set(d, reach);
  const V max_contacts = hn::Set(d, static_cast<float>(max_slide_contacts));
  for (std::size_t i = 0; i < b.count; i += hn::Lanes(d)) {
    const V x = hn::Load(d, &b.left_x[i]), y = hn::Load(d, &b.left_y[i]);
    const V far = hn::Sqrt(hn::Add(hn::Mul(x, x), hn::Mul(y, y)));
    const V share = hn::IfThenElse(hn::Gt(far, r), hn::Div(r, far), hn::Set(d, 1.0f));
    hn::Store(share, d, &b.share[i]);
    hn::Store(hn::Add(hn::Mul(share, x), hn::Load(d, &b.lean_x[i])), d, &b.piece_x[i]);
    hn::Store(hn::Add(hn::Mul(share, y), hn::Load(d, &b.lean_y[i])), d, &b.piece_y[i]);
    if (is_first) hn::Store(hn::Add(hn::Ceil(hn::Div(far, r)), max_contacts), d, &b.pieces[i]);
  }
}

/// Moves by the pieces up to the contacts, as ContactMoves::slid does, and puts the robots where
/// they are then. Robots whose move continues stay in the block.
void slide_on(Block& b, float guard, float waves, float* xs, float* ys) {
  const RobotTag d;
  const hn::RebindToSigned<RobotTag> di;
  using V = hn::Vec<RobotTag>;
  const V one = hn::Set(d, 1.0f);
  const V least = hn::Set(d, guard), lean = hn::Set(d, guard / 4);
  std::size_t kept = 0;
  for (std::size_t i = 0; i < b.count; i += hn::Lanes(d)) {
    const V left_x = hn::Load(d, &b.left_x[i]), left_y = hn::Load(d, &b.left_y[i]);
    const V n_x = hn::Load(d, &b.normal_x[i]), n_y = hn::Load(d, &b.normal_y[i]);
    const V share = hn::Load(d, &b.share[i]), time = hn::Load(d, &b.time[i]);
    const auto met = hn::Le(time, one);
    const V part = hn::Min(time, one);
    const V x = hn::Add(hn::Load(d, &b.x[i]), hn::Mul(part, hn::Load(d, &b.piece_x[i])));
    const V y = hn::Add(hn::Load(d, &b.y[i]), hn::Mul(part, hn::Load(d, &b.piece_y[i])));
    hn::Store(x, d, &b.x[i]);
    hn::Store(y, d, &b.y[i]);
    const std::size_t end = std::min(b.count, i + hn::Lanes(d));
    if (waves == 0 && end - i == hn::Lanes(d)) {  // Robots have not left the block yet.
      hn::StoreU(x, d, xs + i);
      hn::StoreU(y, d, ys + i);
    } else {
      for (std::size_t k = i; k < end; ++k) {
        xs[b.robot[k]] = b.x[k];
        ys[b.robot[k]] = b.y[k];
      }
    }
    const V rest_x = hn::Sub(left_x, hn::Mul(part, hn::Mul(share, left_x)));
    const V rest_y = hn::Sub(left_y, hn::Mul(part, hn::Mul(share, left_y)));
    const V along = hn::Sub(hn::Mul(rest_y, n_x), hn::Mul(rest_x, n_y));
    const V contacts = hn::Add(hn::Load(d, &b.contacts[i]), hn::IfThenElseZero(met, one));
    const V pieces = hn::Load(d, &b.pieces[i]);
    const auto slides =
        hn::And(hn::Ge(hn::Abs(along), least),
                hn::Lt(contacts, hn::Set(d, static_cast<float>(max_slide_contacts))));
    const auto goes_on =
        hn::And(hn::And(hn::FirstN(d, end - i), hn::Lt(hn::Set(d, waves + 1), pieces)),
                hn::Or(hn::And(met, slides), hn::AndNot(met, hn::Lt(share, one))));
    // Only the lanes' indices are compressed: with a table, as for AVX2, Compress is slow.
    const auto lanes =
        hn::IndicesFromVec(d, hn::Compress(hn::Iota(di, 0), hn::RebindMask(di, goes_on)));
    const auto keep = [&](V v, float* to) {
      hn::StoreU(hn::TableLookupLanes(v, lanes), d, to + kept);
    };
    keep(x, b.x.data());
    keep(y, b.y.data());
    keep(hn::IfThenElse(met, hn::Mul(hn::Neg(along), n_y), rest_x), b.left_x.data());
    keep(hn::IfThenElse(met, hn::Mul(along, n_x), rest_y), b.left_y.data());
    keep(hn::IfThenElse(met, hn::Mul(lean, n_x), hn::Load(d, &b.lean_x[i])), b.lean_x.data());
    keep(hn::IfThenElse(met, hn::Mul(lean, n_y), hn::Load(d, &b.lean_y[i])), b.lean_y.data());
    keep(contacts, b.contacts.data());
    keep(pieces, b.pieces.data());
    const auto robot = hn::BitCast(d, hn::Load(di, &b.robot[i]));
    hn::StoreU(hn::BitCast(di, hn::TableLookupLanes(robot, lanes)), di, b.robot.data() + kept);
    kept += hn::CountTrue(d, goes_on);
  }
  b.count = kept;
}

/// ContactMoves::slid for the robots of the block, which are at x, y.
void slide(const WallFaces& faces, Block& b, float* x, float* y) {
  const std::size_t count = b.count;
  std::iota(b.robot.begin(), b.robot.begin() + static_cast<std::ptrdiff_t>(count), 0);
  std::fill_n(b.lean_x.begin(), count, 0.0f);
  std::fill_n(b.lean_y.begin(), count, 0.0f);
  std::fill_n(b.contacts.begin(), count, 0.0f);
  for (float waves = 0; b.count > 0; ++waves) {
    set_pieces(b, faces.reach(), waves == 0);
    find_contacts<true>(faces, b);
    slide_on(b, faces.guard(), waves, x, y);
  }
}

void step_here(const WallFaces& faces, const RobotMoves& moves, ContactRule rule, float* x,
               float* y, std::size_t count) {
  Block b;
  for (std::size_t i = 0; i < count; i += Block::size) {
    take(moves, i, x + i, y + i, std::min(Block::size, count - i), b);
    if (rule == ContactRule::slide)
      slide(faces, b, x + i, y + i);
    else
      stop_or_reject(faces, rule, b, x + i, y + i);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace microswarm
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace microswarm {

HWY_EXPORT(step_here);

void step_lanes(const WallFaces& faces, const RobotMoves& moves, ContactRule rule,
                std::span<float> x, std::span<float> y) {
  HWY_DYNAMIC_DISPATCH(step_here)(faces, moves, rule, x.data(), y.data(), x.size());
}

}  // namespace microswarm
#endif
