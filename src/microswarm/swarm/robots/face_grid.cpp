// SPDX-License-Identifier: Apache-2.0
#include "microswarm/swarm/robots/face_grid.hpp"

#include <algorithm>
#include <iterator>
#include <numbers>
#include <unordered_map>

#include "microswarm/core/maths/hash.hpp"

namespace microswarm {
namespace {

constexpr double max_cells = 1 << 19;
constexpr double rounding_of_guard = 8;  // of cells, positions and contacts
constexpr float short_of_guard = 4;

/// Places that a robot reaches from the origin by moves in one eighth of all directions, or in any:
/// a triangle around the sector, or the disc.
struct Reachable {
  double reach = 0;
  std::size_t direction = 0;
  Vec2 straight, oblique;  ///< the directions that bound the eighth

  bool is_any() const { return direction == FaceGrid::any_direction; }

  /// Greatest component along `axis`.
  double most(Vec2 axis) const {
    if (is_any()) return reach * norm(axis);
    constexpr double cos_pi_8 = 0.92387953251128674;
    const double far = reach / cos_pi_8;
    return std::max({0.0, far * dot(straight, axis), far * dot(oblique, axis)});
  }
};

Reachable reachable(double reach, std::size_t direction) {
  const double x = (direction & 1) != 0 ? -1 : 1, y = (direction & 2) != 0 ? -1 : 1;
  const Vec2 straight = (direction & 4) != 0 ? Vec2{0, y} : Vec2{x, 0};
  return {reach, direction, straight, std::numbers::sqrt2 / 2 * Vec2{x, y}};
}

/// Whether every move in these directions that is not short leaves the face by more than an eighth
/// of the guard, so that it is no contact.
bool always_leaves(const WallFace& face, const Reachable& moves) {
  const Vec2 normal{face.normal.x, face.normal.y};
  return !moves.is_any() &&
         std::min(dot(normal, moves.straight), dot(normal, moves.oblique)) * short_of_guard > 0.25;
}

/// Bounds of dot(axis, centre of a cell).
struct Strip {
  Vec2 axis;
  double low, high;
};

}  // namespace

class FaceGridBuilder {
 public:
  FaceGridBuilder(FaceGrid& grid, const Box& bounds, std::span<const WallFace> faces, float reach,
                  float guard)
      : grid_(grid), faces_(faces), low_(bounds.lo), margin_(rounding_of_guard * guard) {
    const double area = bounds.width() * bounds.height();
    cell_ = std::max(static_cast<double>(reach), std::sqrt(area / max_cells));
    columns_ = static_cast<std::size_t>(bounds.width() / cell_) + 1;
    rows_ = static_cast<std::size_t>(bounds.height() / cell_) + 1;
    grid.columns = columns_;
    grid.low = {static_cast<float>(low_.x), static_cast<float>(low_.y)};
    grid.per_cell = static_cast<float>(1 / cell_);
    grid.last_column = static_cast<float>(columns_ - 1);
    grid.last_row = static_cast<float>(rows_ - 1);
    grid.short_move = short_of_guard * guard;
    grid.lists_.assign(FaceGrid::lists_a_cell * columns_ * rows_, 0);
    grid.packs_.resize(1);
    add_faces(reachable(reach, FaceGrid::any_direction));
    find_crowded();
    for (std::size_t direction = 0; direction < FaceGrid::any_direction; ++direction)
      add_faces(reachable(reach, direction));
    for (std::size_t cell = 0; cell < columns_ * rows_; ++cell) pack_cell(cell);
  }

 private:
  struct Entry {
    std::uint32_t face;
    std::uint32_t next;
  };
  struct KnownList {
    std::uint32_t pack;
    std::size_t begin, size;  ///< in known_faces_
  };
  using Faces = std::vector<std::uint32_t>;

  // Backwards, so that each chain is in the order of the faces.
  void add_faces(const Reachable& moves) {
    for (std::size_t id = faces_.size(); id-- > 0;)
      if (!always_leaves(faces_[id], moves)) add_face(static_cast<std::uint32_t>(id), moves);
  }

  std::uint32_t* cell_lists(std::size_t cell) {
    return grid_.lists_.data() + FaceGrid::lists_a_cell * cell;
  }

  void follow(std::uint32_t chain, Faces& faces) const {
    faces.clear();
    for (; chain != 0; chain = chains_[chain].next) faces.push_back(chains_[chain].face);
  }

  /// Only cells with more faces than a pack holds need lists by direction.
  void find_crowded() {
    is_crowded_.assign(columns_ * rows_, 0);
    for (std::size_t cell = 0; cell < is_crowded_.size(); ++cell) {
      std::size_t count = 0;
      for (std::uint32_t at = cell_lists(cell)[FaceGrid::any_direction]; at != 0;
           at = chains_[at].next)
        ++count;
      is_crowded_[cell] = count > FacePack::size;
    }
  }

  /// Replaces the chains of a cell by packs. Neighbouring directions share one pack if it holds the
  /// faces of all of them.
  void pack_cell(std::size_t cell) {
    constexpr std::array<std::size_t, 8> anticlockwise{0, 4, 5, 1, 3, 7, 6, 2};
    std::uint32_t* lists = cell_lists(cell);
    if (lists[FaceGrid::any_direction] == 0) return;
    Faces one, both, shared;
    follow(lists[FaceGrid::any_direction], shared);
    lists[FaceGrid::any_direction] = pack_count(shared);
    if (!is_crowded_[cell]) {
      std::fill_n(lists, 8, lists[FaceGrid::any_direction]);
      return;
    }
    shared.clear();
    std::size_t first = 0;
    for (std::size_t k = 0; k <= 8; ++k) {
      if (k < 8) {
        follow(lists[anticlockwise[k]], one);
        both.clear();
        std::ranges::set_union(one, shared, std::back_inserter(both));
      }
      if (k == 8 || (k > first && both.size() > FacePack::size)) {
        const std::uint32_t pack = pack_count(shared);
        for (; first < k; ++first) lists[anticlockwise[first]] = pack;
        both = one;
      }
      std::swap(shared, both);
    }
  }

  // The cells whose square, moved by the reachable places, meets the face: no line separates them.
  void add_face(std::uint32_t id, const Reachable& moves) {
    const WallFace& face = faces_[id];
    const Vec2 normal{face.normal.x, face.normal.y};
    const Vec2 middle{face.middle.x, face.middle.y};
    const Vec2 half = static_cast<double>(face.half_length) * Vec2{-normal.y, normal.x};
    const auto strip = [&](Vec2 axis) {
      const double centre = dot(middle, axis), extent = std::abs(dot(half, axis));
      const double square = (0.5 * cell_ + margin_) * (std::abs(axis.x) + std::abs(axis.y));
      return Strip{axis, centre - extent - square - moves.most(axis),
                   centre + extent + square + moves.most(-axis)};
    };
    const Vec2 between = moves.straight + moves.oblique;
    const std::array strips{strip({1, 0}), strip(normal),
                            strip({-moves.oblique.y, moves.oblique.x}), strip(between)};
    const Strip upright = strip({0, 1});
    const auto rows = range((upright.low - low_.y) / cell_, (upright.high - low_.y) / cell_, rows_);
    for (std::size_t row = rows.first; row < rows.second; ++row)
      add_row(id, moves.direction, row, strips);
  }

  void add_row(std::uint32_t id, std::size_t direction, std::size_t row,
               std::span<const Strip> strips) {
    constexpr double level = 1e-9;
    const double y = low_.y + cell_ * (static_cast<double>(row) + 0.5);
    double left = -1e300, right = 1e300;
    for (const Strip& strip : strips) {
      const double low = strip.low - y * strip.axis.y, high = strip.high - y * strip.axis.y;
      if (std::abs(strip.axis.x) < level) {
        if (low > level * cell_ || high < -level * cell_) return;
        continue;
      }
      const double a = low / strip.axis.x, b = high / strip.axis.x;
      left = std::max(left, std::min(a, b));
      right = std::min(right, std::max(a, b));
    }
    const auto columns = range((left - low_.x) / cell_, (right - low_.x) / cell_, columns_);
    for (std::size_t column = columns.first; column < columns.second; ++column) {
      const std::size_t cell = row * columns_ + column;
      if (direction != FaceGrid::any_direction && !is_crowded_[cell]) continue;
      std::uint32_t& chain = cell_lists(cell)[direction];
      chains_.push_back({id, chain});
      chain = static_cast<std::uint32_t>(chains_.size() - 1);
    }
  }

  /// Indices, up to an end, of the cells whose centres lie between these places in cells.
  static std::pair<std::size_t, std::size_t> range(double low, double high, std::size_t count) {
    const double end = static_cast<double>(count);
    const double first = std::clamp(std::ceil(low - 0.5), 0.0, end);
    return {static_cast<std::size_t>(first),
            static_cast<std::size_t>(std::clamp(std::floor(high - 0.5) + 1, first, end))};
  }

  /// First pack of these faces, the same for equal lists.
  std::uint32_t pack_count(const Faces& list) {
    if (list.empty()) return 0;
    Hash hash;
    hash.bytes(std::as_bytes(std::span(list)));
    const KnownList added{static_cast<std::uint32_t>(grid_.packs_.size()), known_faces_.size(),
                          list.size()};
    const auto [position, is_new] = known_.try_emplace(hash.digest(), added);
    const KnownList& known = position->second;
    if (!is_new &&
        std::ranges::equal(std::span(known_faces_).subspan(known.begin, known.size), list))
      return known.pack;
    if (is_new) known_faces_.insert(known_faces_.end(), list.begin(), list.end());
    add_packs(list);
    return added.pack;
  }

  void add_packs(const Faces& list) {
    const std::size_t count = (list.size() + FacePack::size - 1) / FacePack::size;
    for (std::size_t k = 0; k < list.size(); ++k) {
      const std::size_t lane = k % FacePack::size;
      if (lane == 0) {
        grid_.packs_.emplace_back();
        grid_.packs_.back().following = static_cast<std::uint32_t>(count - 1 - k / FacePack::size);
      }
      FacePack& to = grid_.packs_.back();
      const WallFace& face = faces_[list[k]];
      to.middle_x[lane] = face.middle.x;
      to.middle_y[lane] = face.middle.y;
      to.normal_x[lane] = face.normal.x;
      to.normal_y[lane] = face.normal.y;
      to.half_length[lane] = face.half_length;
    }
  }

  FaceGrid& grid_;
  std::span<const WallFace> faces_;
  Vec2 low_;
  double margin_;
  double cell_ = 1;
  std::size_t columns_ = 1, rows_ = 1;
  std::vector<Entry> chains_{{}};  ///< of faces, by list; 0 ends one
  std::vector<std::uint8_t> is_crowded_;
  std::unordered_map<std::uint64_t, KnownList> known_;
  Faces known_faces_;
};

FaceGrid::FaceGrid(const Box& bounds, std::span<const WallFace> faces, float reach, float guard) {
  FaceGridBuilder(*this, bounds, faces, reach, guard);
}

}  // namespace microswarm
