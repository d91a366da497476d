// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <bit>
#include <cassert>

#include "microswarm/world/map/clearance_field.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "microswarm/world/map/place_lookup.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h.
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace microswarm {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

class PlaceLookup {
 public:
  PlaceLookup(const ClearanceField::Grid& grid, double r) : grid_(grid), r_(r) {}

  /// Decides about as many places as a vector has lanes; returns one bit for each undecided one.
  HWY_INLINE unsigned decide(const Vec2* positions, std::uint8_t* free) const {
    static_assert(sizeof(Vec2) == 2 * sizeof(double));
    V x, y;
    hn::LoadInterleaved2(D(), &positions->x, x, y);
    const Cells cells = hn::Add(
        hn::Mul(cell_along(y, grid_.origin.y, grid_.last_row), hn::Set(OfCells(), grid_.stride)),
        cell_along(x, grid_.origin.x, grid_.last_column));
    const V lower = hn::PromoteTo(D(), hn::GatherIndex(OfBounds(), grid_.lower, cells));
    const auto is_free = hn::Ge(lower, hn::Set(D(), r_));
    const V beside = hn::Abs(hn::Sub(lower, hn::Set(D(), r_ - 0.5 * grid_.spread)));
    const auto is_decided = hn::Gt(beside, hn::Set(D(), grid_.doubt));
    std::array<std::uint8_t, 8> bits;
    hn::StoreMaskBits(D(), is_free, bits.data());
    const unsigned frees = bits[0];
    hn::StoreMaskBits(D(), is_decided, bits.data());
    for (std::size_t k = 0; k < lanes(); ++k) free[k] = (frees >> k) & 1;
    return ~unsigned{bits[0]} & ((1u << lanes()) - 1);
  }
  static HWY_INLINE std::size_t lanes() { return hn::Lanes(D()); }

 private:
  using D = hn::CappedTag<double, 8>;
  using V = hn::Vec<D>;
  using OfCells = hn::Rebind<std::int32_t, D>;
  using OfBounds = hn::Rebind<float, D>;
  using Cells = hn::Vec<OfCells>;

  /// Row or column, as ClearanceField::cell_at: 0 if the coordinate is no number.
  HWY_INLINE Cells cell_along(V coordinate, double origin, double last) const {
    const V i = hn::Mul(hn::Sub(coordinate, hn::Set(D(), origin)), hn::Set(D(), grid_.per_cell));
    const V at_least_0 = hn::IfThenElseZero(hn::Gt(i, hn::Zero(D())), i);
    return hn::DemoteTo(OfCells(), hn::Min(at_least_0, hn::Set(D(), last)));
  }

  ClearanceField::Grid grid_;
  double r_;
};

std::size_t decide_here(const ClearanceField::Grid& grid, std::span<const Vec2> positions, double r,
                        std::uint8_t* free, std::uint32_t* undecided) {
  const PlaceLookup lookup(grid, r);
  const std::size_t lanes = PlaceLookup::lanes();
  std::size_t count = 0;
  const auto note = [&](std::size_t first, unsigned bits) HWY_ATTR {
    for (; bits != 0; bits &= bits - 1)
      undecided[count++] = static_cast<std::uint32_t>(first) + std::countr_zero(bits);
  };
  std::size_t i = 0;
  for (; i + lanes <= positions.size(); i += lanes) note(i, lookup.decide(&positions[i], free + i));
  const std::size_t left = positions.size() - i;
  if (left == 0) return count;
  std::array<Vec2, 8> last{};
  std::array<std::uint8_t, 8> decided;
  for (std::size_t k = 0; k < left; ++k) last[k] = positions[i + k];
  note(i, lookup.decide(last.data(), decided.data()) & ((1u << left) - 1));
  for (std::size_t k = 0; k < left; ++k) free[i + k] = decided[k];
  return count;
}

}  // namespace HWY_NAMESPACE
}  // namespace microswarm
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace microswarm {

HWY_EXPORT(decide_here);

std::size_t ClearanceField::decide(std::span<const Vec2> positions, double r,
                                   std::span<std::uint8_t> free,
                                   std::span<std::uint32_t> undecided) const {
  assert(free.size() >= positions.size() && undecided.size() >= positions.size());
  const Grid grid{
      origin_,       per_cell_, last_column_, last_row_, static_cast<std::int32_t>(stride_),
      lower_.data(), spread_,   doubt_};
  return HWY_DYNAMIC_DISPATCH(decide_here)(grid, positions, r, free.data(), undecided.data());
}

}  // namespace microswarm
#endif
