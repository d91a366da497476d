// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

namespace microswarm::vision {

/// A local maximum of a picture.
struct Peak {
  int column = 0;
  int row = 0;
  friend bool operator==(const Peak&, const Peak&) = default;
};

/// Replaces the peaks of each plateau of more than four adjacent pixels, such as the middle of a
/// flat or an overexposed disc, by the one nearest to their mean. `peaks` are sorted by row, then
/// by column, and remain so. Smaller groups are kept whole.
void thin_plateaus(std::vector<Peak>& peaks);

}  // namespace microswarm::vision
