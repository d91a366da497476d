// SPDX-License-Identifier: Apache-2.0
#include "microswarm/vision/tracking/peaks.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <tuple>

namespace microswarm::vision {
namespace {

constexpr std::int64_t kept_whole = 4;  // peaks of a plateau

/// Connected groups of peaks, eight neighbours to a pixel, as a forest of parents.
class Plateaus {
 public:
  explicit Plateaus(const std::vector<Peak>& peaks) : parent_(peaks.size()) {
    std::iota(parent_.begin(), parent_.end(), 0);
    std::size_t above = 0;  // the first peak that may touch from the row above
    for (std::size_t i = 0; i < peaks.size(); ++i) {
      const Peak at = peaks[i];
      if (i > 0 && peaks[i - 1] == Peak{at.column - 1, at.row}) join(i - 1, i);
      const auto before = [&](Peak p) {
        return std::tie(p.row, p.column) < std::make_tuple(at.row - 1, at.column - 1);
      };
      while (before(peaks[above])) ++above;
      for (std::size_t k = above;
           k < i && peaks[k].row == at.row - 1 && peaks[k].column <= at.column + 1; ++k)
        join(k, i);
    }
  }
  std::size_t root(std::size_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }

 private:
  void join(std::size_t a, std::size_t b) {
    a = root(a);
    b = root(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }
  std::vector<std::size_t> parent_;
};

struct Group {
  std::int64_t count = 0, columns = 0, rows = 0;
  std::int64_t least = -1;  ///< squared distance from the mean, times count²
  std::size_t nearest = 0;
};

}  // namespace

void thin_plateaus(std::vector<Peak>& peaks) {
  Plateaus plateaus(peaks);
  std::vector<Group> groups(peaks.size());
  for (std::size_t i = 0; i < peaks.size(); ++i) {
    Group& group = groups[plateaus.root(i)];
    ++group.count;
    group.columns += peaks[i].column;
    group.rows += peaks[i].row;
  }
  for (std::size_t i = 0; i < peaks.size(); ++i) {
    Group& group = groups[plateaus.root(i)];
    const std::int64_t dx = group.count * peaks[i].column - group.columns;
    const std::int64_t dy = group.count * peaks[i].row - group.rows;
    const std::int64_t squared = dx * dx + dy * dy;
    if (group.least >= 0 && squared >= group.least) continue;
    group.least = squared;
    group.nearest = i;
  }
  std::size_t kept = 0;
  for (std::size_t i = 0; i < peaks.size(); ++i) {
    const Group& group = groups[plateaus.root(i)];
    if (group.count <= kept_whole || group.nearest == i) peaks[kept++] = peaks[i];
  }
  peaks.resize(kept);
}

}  // namespace microswarm::vision
