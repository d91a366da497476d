// SPDX-License-Identifier: Apache-2.0
#include "microswarm/world/map/field_painter.hpp"
#include "microswarm/core/fields/overloaded.hpp"
#include "microswarm/geometry/l1_norm.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

namespace microswarm {
namespace {

/// Blocks with this many candidates or cells are not divided further.
constexpr std::size_t few_candidates = 1;
constexpr int few_cells = 4;

/// A float certainly below `x`.
float float_below(double x) {
  return std::nextafter(static_cast<float>(x), -std::numeric_limits<float>::infinity());
}

}  // namespace

FieldPainter::FieldPainter(const Box& bounds, const BodySet& bodies, ClearanceField& field)
    : bounds_(bounds), bodies_(bodies), field_(field) {
  double largest = l1_norm(bounds.lo) + l1_norm(bounds.hi);
  const auto add = [&](WallCandidates& candidates, const Segment& core, double radius) {
    largest = std::max(largest, l1_norm(core.a) + radius);
    candidates.push(core, radius, static_cast<std::uint32_t>(field.walls_.size()));
    field.walls_.push_back({core, radius});
  };
  for (const Body& body : bodies.bodies()) {
    std::visit(Overloaded{[&](const Disc& disc) {
                            add(discs_, {disc.centre, disc.centre}, disc.radius);
                          },
                          [&](const Polygon& polygon) {
                            for_each_edge(polygon, [&](Vec2 a, Vec2 b) { add(edges_, {a, b}, 0); });
                          }},
               body.shape);
  }
  rounding_ = 1e-14 * largest;
}

void FieldPainter::paint() {
  paint({0, field_.columns(), 0, field_.rows()}, {0, 0},
        bodies_.polygons().empty() ? Solid::no : Solid::unknown);
}

Vec2 FieldPainter::point(double column, double row) const {
  return {bounds_.lo.x + column * field_.cell_, bounds_.lo.y + row * field_.cell_};
}

Vec2 FieldPainter::block_centre(const Block& block) const {
  return point(0.5 * (block.left + block.right), 0.5 * (block.bottom + block.top));
}

double FieldPainter::half_diagonal(const Block& block) const {
  return 0.5 * field_.cell_ *
             norm(Vec2{1.0 * (block.right - block.left), 1.0 * (block.top - block.bottom)}) *
             (1 + 1e-9) +
         rounding_;
}

std::size_t FieldPainter::count_from(Start start) const {
  return edges_.size() - start.edges + discs_.size() - start.discs;
}

void FieldPainter::cut(Start start) {
  edges_.cut(start.edges);
  discs_.cut(start.discs);
}

FieldPainter::Look FieldPainter::look(const Block& block, Start start, Solid solid) {
  const Vec2 centre = block_centre(block);
  const double edge = edges_.measure(centre, start.edges);
  if (solid == Solid::unknown && edge > half_diagonal(block))
    solid = bodies_.polygons().holds(centre) ? Solid::yes : Solid::no;
  return {edge, discs_.measure(centre, start.discs), solid};
}

// Pushes those candidates from `start` on that can be nearest in `block`. In a polygon, edges and
// discs are compared separately, since depth and disc distance both count; outside, only the
// nearest of all matters.
FieldPainter::Look FieldPainter::narrow(const Block& block, Start start, Solid solid) {
  const double half = half_diagonal(block);
  const Look seen = look(block, start, solid);
  if (seen.solid == Solid::no) {
    const auto bound = (seen.edge < seen.disc ? edges_ : discs_).bound(half);
    edges_.push_rivals(bound);
    discs_.push_rivals(bound);
  } else {
    edges_.push_rivals(edges_.bound(half));
    discs_.push_rivals(discs_.bound(half));
  }
  return seen;
}

// The candidates of the block are those from `start` on.
void FieldPainter::paint(const Block& block, Start start, Solid solid) {
  if (block.cells() <= few_cells || count_from(start) <= few_candidates) {
    paint_cells(block, start, solid);
    return;
  }
  const Start own = top();
  const int column = (block.left + block.right) / 2;
  const int row = (block.bottom + block.top) / 2;
  for (const Block& quarter :
       {Block{block.left, column, block.bottom, row}, Block{column, block.right, block.bottom, row},
        Block{block.left, column, row, block.top}, Block{column, block.right, row, block.top}}) {
    if (quarter.cells() == 0) continue;
    const Solid known = narrow(quarter, start, solid).solid;
    paint(quarter, own, known);
    cut(own);
  }
}

void FieldPainter::paint_cells(const Block& block, Start start, Solid solid) {
  const Start own = top();
  const bool is_short = count_from(start) <= few_candidates;
  if (is_short) store_list(start);
  for (int row = block.bottom; row < block.top; ++row) {
    for (int column = block.left; column < block.right; ++column) {
      const Block cell{column, column + 1, row, row + 1};
      if (is_short) {
        paint_cell(column, row, look(cell, start, solid));
        continue;
      }
      const Look seen = narrow(cell, start, solid);
      store_list(own);
      paint_cell(column, row, seen);
      cut(own);
    }
  }
}

void FieldPainter::paint_cell(int column, int row, const Look& seen) {
  const Vec2 p = point(column + 0.5, row + 0.5);
  const bool inside =
      seen.solid == Solid::yes || (seen.solid == Solid::unknown && bodies_.polygons().holds(p));
  const double clearance = std::min({inside ? -seen.edge : seen.edge, seen.disc, p.x - bounds_.lo.x,
                                     bounds_.hi.x - p.x, p.y - bounds_.lo.y, bounds_.hi.y - p.y});
  const std::size_t cell = (static_cast<std::size_t>(row) + 1) * field_.stride_ + column + 1;
  field_.lower_[cell] = float_below(clearance - half_diagonal({0, 1, 0, 1}));
  field_.nearest_[cell] = list_;
}

// Neighbouring cells mostly have the same list, which is stored once.
void FieldPainter::store_list(Start start) {
  walls_.clear();
  for (const auto& walls : {edges_.walls(start.edges), discs_.walls(start.discs)})
    walls_.insert(walls_.end(), walls.begin(), walls.end());
  const std::size_t n = walls_.size();
  if (n == 0) return;
  if (n <= 2) {
    list_ = {walls_[0], walls_[n - 1]};
    return;
  }
  for (std::uint32_t& wall : walls_) wall *= 2;
  ++walls_.back();
  auto& lists = field_.lists_;
  if (!std::ranges::equal(walls_, std::span(lists).subspan(last_list_))) {
    last_list_ = static_cast<std::uint32_t>(lists.size());
    lists.insert(lists.end(), walls_.begin(), walls_.end());
  }
  list_ = {ClearanceField::is_list, last_list_};
}

}  // namespace microswarm
