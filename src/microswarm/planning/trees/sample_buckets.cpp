// SPDX-License-Identifier: Apache-2.0
#include "microswarm/planning/trees/sample_buckets.hpp"

namespace microswarm {

SampleBuckets::SampleBuckets(std::span<const Vec2> points, double radius)
    : radius_(radius), box_(bounding_box(points)), placed_(points.size()) {
  // The number of cells stays near the number of points, however small the radius.
  const double count = static_cast<double>(points.size());
  cell_ = std::max({radius, std::sqrt(box_.width() * box_.height() / count),
                    (box_.width() + box_.height()) / count});
  columns_ = static_cast<int>(box_.width() / cell_) + 1;
  rows_ = static_cast<int>(box_.height() / cell_) + 1;
  const auto cell_of = [&](Vec2 p) {
    return static_cast<std::size_t>(index(p.y - box_.lo.y, rows_)) *
               static_cast<std::size_t>(columns_) +
           static_cast<std::size_t>(index(p.x - box_.lo.x, columns_));
  };
  // Counting sort: first the ends of the cells; filling from the back leaves their starts.
  first_.assign(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_) + 1, 0);
  for (const Vec2 p : points) ++first_[cell_of(p)];
  for (std::size_t i = 1; i < first_.size(); ++i) first_[i] += first_[i - 1];
  for (std::size_t i = points.size(); i-- > 0;)
    placed_[--first_[cell_of(points[i])]] = {points[i], static_cast<std::uint32_t>(i)};
}

void SampleBuckets::append_near(Vec2 p, std::vector<std::uint32_t>& out) const {
  const int column = index(p.x - box_.lo.x, columns_);
  const int row = index(p.y - box_.lo.y, rows_);
  const auto left = static_cast<std::size_t>(std::max(0, column - 1));
  const auto end = static_cast<std::size_t>(std::min(columns_ - 1, column + 1)) + 1;
  for (int r = std::max(0, row - 1); r <= std::min(rows_ - 1, row + 1); ++r) {
    const std::size_t begin = static_cast<std::size_t>(r) * static_cast<std::size_t>(columns_);
    const std::span<const Placed> run(placed_.data() + first_[begin + left],
                                      placed_.data() + first_[begin + end]);
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

}  // namespace microswarm
