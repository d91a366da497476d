// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace microswarm {

/// Entry of a std::priority_queue or a heap whose top is the cheapest; of equals the lowest number.
template <class Cost, class Node = std::uint32_t>
struct HeapEntry {
  Cost cost{};
  Node node{};
  friend constexpr bool operator<(const HeapEntry& a, const HeapEntry& b) {
    return a.cost != b.cost ? a.cost > b.cost : a.node > b.node;
  }
};

}  // namespace microswarm
