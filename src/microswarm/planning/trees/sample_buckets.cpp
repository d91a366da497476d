// SPDX-License-Identifier: Apache-2.0
#include "microswarm/planning/trees/sample_buckets.hpp"

namespace microswarm::planning {

SampleBuckets::SampleBuckets(std::span<const Vec2> points, double radius)
    : radius_(radius), placed_(points.size()) {
  const Box box = bounding_box(points);
  // The number of cells stays near the number of points, however small the radius.
  const double count = static_cast<double>(points.size());
  grid_ = {box, std::max({radius, std::sqrt(box.width() * box.height() / count),
                          (box.width() + box.height()) / count})};
  // Counting sort: first the ends of the cells; filling from the back leaves their starts.
  first_.assign(grid_.size() + 1, 0);
  for (const Vec2 p : points) ++first_[grid_.number_at(p)];
  for (std::size_t i = 1; i < first_.size(); ++i) first_[i] += first_[i - 1];
  for (std::size_t i = points.size(); i-- > 0;)
    placed_[--first_[grid_.number_at(points[i])]] = {points[i], static_cast<std::uint32_t>(i)};
}

void SampleBuckets::append_near(Vec2 p, std::vector<std::uint32_t>& out) const {
  const int column = grid_.find_column(p.x), row = grid_.find_row(p.y);
  const int left = std::max(0, column - 1), right = std::min(grid_.columns() - 1, column + 1);
  for (int r = std::max(0, row - 1); r <= std::min(grid_.rows() - 1, row + 1); ++r) {
    const std::span<const Placed> run(placed_.data() + first_[grid_.number(left, r)],
                                      placed_.data() + first_[grid_.number(right, r) + 1]);
    // Branchless: always written, kept if near, since the test is unpredictable.
    std::size_t kept = out.size();
    out.resize(kept + run.size());
    for (const Placed& other : run) {
      const double squared = squared_norm(other.position - p);
      out[kept] = other.index;
      kept += static_cast<std::size_t>(squared <= radius_ * radius_) &
              static_cast<std::size_t>(squared > 0);
    }
    out.resize(kept);
  }
}

}  // namespace microswarm::planning
