// SPDX-License-Identifier: Apache-2.0
#include "microswarm/world/map/field_painter.hpp"

#include <algorithm>
#include <cmath>

#include "microswarm/core/maths/infinity.hpp"

namespace microswarm {
namespace {

constexpr double no_disc = -1;
/// Blocks with this many candidates or cells are not divided further.
constexpr std::size_t few_candidates = 1;
constexpr int few_cells = 4;

double magnitude(Vec2 p) { return std::abs(p.x) + std::abs(p.y); }

/// A float certainly below `x`.
float float_below(double x) {
  return std::nextafter(static_cast<float>(x), -std::numeric_limits<float>::infinity());
}

}  // namespace

void FieldPainter::Candidates::reserve(std::size_t n) {
  if (n <= wall.size()) return;
  for (auto* values : {&x, &y, &u, &v, &per_length2, &radius}) values->resize(2 * n);
  wall.resize(2 * n);
}

void FieldPainter::Candidates::push(Segment core, double disc_radius, std::uint32_t index) {
  reserve(size + 1);
  const Vec2 along = core.b - core.a;
  const double length2 = squared_norm(along);
  x[size] = core.a.x;
  y[size] = core.a.y;
  u[size] = along.x;
  v[size] = along.y;
  per_length2[size] = length2 > 0 ? 1 / length2 : 0;
  radius[size] = disc_radius;
  wall[size++] = index;
}

void FieldPainter::Candidates::push_copy(std::size_t i) {
  for (auto* values : {&x, &y, &u, &v, &per_length2, &radius}) (*values)[size] = (*values)[i];
  wall[size++] = wall[i];
}

FieldPainter::FieldPainter(const Box& bounds, const BodySet& bodies, ClearanceField& field)
    : bounds_(bounds), bodies_(bodies), field_(field) {
  double largest = magnitude(bounds.lo) + magnitude(bounds.hi);
  auto add = [&](Segment core, const double* disc_radius) {
    const double radius = disc_radius ? *disc_radius : 0;
    largest = std::max(largest, magnitude(core.a) + radius);
    candidates_.push(core, disc_radius ? radius : no_disc,
                     static_cast<std::uint32_t>(field.walls_.size()));
    field.walls_.push_back({core, radius});
  };
  for (const Body& body : bodies.bodies()) {
    if (const auto* disc = std::get_if<Disc>(&body.shape)) {
      add({disc->centre, disc->centre}, &disc->radius);
    } else {
      for_each_edge(std::get<Polygon>(body.shape), [&](Vec2 a, Vec2 b) { add({a, b}, nullptr); });
    }
  }
  rounding_ = 1e-14 * largest;
}

void FieldPainter::paint() {
  paint({0, field_.columns(), 0, field_.rows()}, 0,
        bodies_.polygons().empty() ? Solid::no : Solid::unknown);
}

Vec2 FieldPainter::point(double column, double row) const {
  return {bounds_.lo.x + column * field_.cell_, bounds_.lo.y + row * field_.cell_};
}

double FieldPainter::half_diagonal(const Block& block) const {
  return 0.5 * field_.cell_ *
             norm(Vec2{1.0 * (block.right - block.left), 1.0 * (block.top - block.bottom)}) *
             (1 + 1e-9) +
         rounding_;
}

// Distance of p to the candidates [first, last), negative inside a disc.
FieldPainter::NearestOfEach FieldPainter::measure(Vec2 p, std::size_t first, std::size_t last) {
  const Candidates& c = candidates_;
  const std::size_t n = last - first;
  if (distances_.size() < n) distances_.resize(n);
  double* out = distances_.data();
  const double* x = c.x.data() + first;
  const double* y = c.y.data() + first;
  const double* u = c.u.data() + first;
  const double* v = c.v.data() + first;
  const double* per_length2 = c.per_length2.data() + first;
  const double* radius = c.radius.data() + first;
  for (std::size_t i = 0; i < n; ++i) {
    const double dx = p.x - x[i];
    const double dy = p.y - y[i];
    double t = (dx * u[i] + dy * v[i]) * per_length2[i];
    t = t > 0 ? t : 0;
    t = t < 1 ? t : 1;
    const double ex = dx - t * u[i];
    const double ey = dy - t * v[i];
    out[i] = std::sqrt(ex * ex + ey * ey) - (radius[i] > 0 ? radius[i] : 0);
  }
  NearestOfEach nearest{{infinity, last}, {infinity, last}};
  for (std::size_t i = 0; i < n; ++i) {
    Nearest& least = radius[i] >= 0 ? nearest.disc : nearest.edge;
    if (out[i] < least.distance) least = {out[i], first + i};
  }
  return nearest;
}

/// Vector from p to the nearest point of a candidate.
Vec2 FieldPainter::towards(Vec2 p, std::size_t candidate) const {
  const Candidates& c = candidates_;
  const Vec2 a{c.x[candidate], c.y[candidate]};
  if (c.is_disc(candidate)) {
    const double d = distance(p, a);
    return d > c.radius[candidate] ? (1 - c.radius[candidate] / d) * (a - p) : Vec2{};
  }
  const Vec2 along{c.u[candidate], c.v[candidate]};
  return a + std::clamp(dot(p - a, along) * c.per_length2[candidate], 0.0, 1.0) * along - p;
}

bool FieldPainter::can_be_nearest(Vec2 centre, double half, std::size_t candidate, double distance,
                                  const Nearest& nearest) const {
  const double gap = distance - nearest.distance;
  if (gap > 2 * half) return false;
  const double least = nearest.distance - half;
  if (gap <= 0 || !(least > half)) return true;
  const double apart = norm(towards(centre, candidate) - towards(centre, nearest.candidate));
  return gap * least <= half * (apart + 2 * half) * (1 + 1e-9);
}

// Appends those candidates in [first, last) that can be nearest in `block`. In a polygon, edges and
// discs are compared separately, since depth and disc distance both count; outside, only the
// nearest of all matters.
FieldPainter::Solid FieldPainter::narrow(const Block& block, std::size_t first, std::size_t last,
                                         Solid solid) {
  const Vec2 centre = point(0.5 * (block.left + block.right), 0.5 * (block.bottom + block.top));
  const double half = half_diagonal(block);
  auto [edge, disc] = measure(centre, first, last);
  if (solid == Solid::unknown && edge.distance > half) {
    solid = bodies_.polygons().holds(centre) ? Solid::yes : Solid::no;
  }
  if (solid == Solid::no) edge = disc = edge.distance < disc.distance ? edge : disc;
  candidates_.reserve(candidates_.size + last - first);
  for (std::size_t i = first; i < last; ++i) {
    const Nearest& nearest = candidates_.is_disc(i) ? disc : edge;
    if (can_be_nearest(centre, half, i, distances_[i - first], nearest)) candidates_.push_copy(i);
  }
  return solid;
}

// The candidates of the block are [first, candidates_.size).
void FieldPainter::paint(const Block& block, std::size_t first, Solid solid) {
  const std::size_t last = candidates_.size;
  if (block.cells() <= few_cells || last - first <= few_candidates) {
    paint_cells(block, first, solid);
    return;
  }
  const int column = (block.left + block.right) / 2;
  const int row = (block.bottom + block.top) / 2;
  for (const Block& quarter :
       {Block{block.left, column, block.bottom, row}, Block{column, block.right, block.bottom, row},
        Block{block.left, column, row, block.top}, Block{column, block.right, row, block.top}}) {
    if (quarter.cells() == 0) continue;
    const Solid known = narrow(quarter, first, last, solid);
    paint(quarter, last, known);
    candidates_.size = last;
  }
}

void FieldPainter::paint_cells(const Block& block, std::size_t first, Solid solid) {
  const std::size_t last = candidates_.size;
  const bool is_short = last - first <= few_candidates;
  if (is_short) store_list(first);
  for (int row = block.bottom; row < block.top; ++row) {
    for (int column = block.left; column < block.right; ++column) {
      if (is_short) {
        paint_cell(column, row, first, solid);
        continue;
      }
      const Solid known = narrow({column, column + 1, row, row + 1}, first, last, solid);
      store_list(last);
      paint_cell(column, row, last, known);
      candidates_.size = last;
    }
  }
}

void FieldPainter::paint_cell(int column, int row, std::size_t first, Solid solid) {
  const Vec2 p = point(column + 0.5, row + 0.5);
  const auto [edge, disc] = measure(p, first, candidates_.size);
  const bool inside =
      solid == Solid::yes || (solid == Solid::unknown && bodies_.polygons().holds(p));
  const double clearance =
      std::min({inside ? -edge.distance : edge.distance, disc.distance, p.x - bounds_.lo.x,
                bounds_.hi.x - p.x, p.y - bounds_.lo.y, bounds_.hi.y - p.y});
  const std::size_t cell = (static_cast<std::size_t>(row) + 1) * field_.stride_ + column + 1;
  field_.lower_[cell] = float_below(clearance - half_diagonal({0, 1, 0, 1}));
  field_.nearest_[cell] = list_;
}

// Neighbouring cells mostly have the same list, which is stored once.
void FieldPainter::store_list(std::size_t first) {
  const std::size_t n = candidates_.size - first;
  if (n == 0) return;
  const std::uint32_t* wall = candidates_.wall.data() + first;
  if (n <= 2) {
    list_ = {wall[0], wall[n - 1]};
    return;
  }
  auto& lists = field_.lists_;
  auto entry = [&](std::size_t k) { return 2 * wall[k] + (k + 1 == n ? 1 : 0); };
  bool is_same = lists.size() - last_list_ == n;
  for (std::size_t k = 0; k < n && is_same; ++k) is_same = lists[last_list_ + k] == entry(k);
  if (!is_same) {
    last_list_ = static_cast<std::uint32_t>(lists.size());
    for (std::size_t k = 0; k < n; ++k) lists.push_back(entry(k));
  }
  list_ = {ClearanceField::is_list, last_list_};
}

}  // namespace microswarm
