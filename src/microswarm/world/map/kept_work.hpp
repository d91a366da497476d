// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <typeindex>
#include <utility>
#include <vector>

#include "microswarm/core/execution/mutex.hpp"

namespace microswarm {

/// Cache of algorithms for later queries on a map, such as tangents for one clearance. An entry is
/// taken out while in use, so that each user has its own; it must not change any result.
/// Thread-safe.
class KeptWork {
 public:
  static constexpr std::size_t most = 4;  ///< kept at a time, the latest

  /// The work of this type and clearance [µm], if some is kept.
  template <class Work>
  std::unique_ptr<Work> take(double clearance) {
    const std::lock_guard lock(mutex_);
    for (std::size_t i = entries_.size(); i-- > 0;) {
      Entry& entry = entries_[i];
      if (entry.type != typeid(Work) || entry.clearance != clearance) continue;
      std::unique_ptr<Work> work(static_cast<Work*>(entry.work.release()));
      entries_.erase(entries_.begin() + static_cast<std::ptrdiff_t>(i));
      return work;
    }
    return nullptr;
  }

  template <class Work>
  void keep(double clearance, std::unique_ptr<Work> work) {
    Erased erased(work.release(), [](void* p) { delete static_cast<Work*>(p); });
    std::optional<Entry> oldest;  // ends after the lock
    const std::lock_guard lock(mutex_);
    if (entries_.size() == most) {
      oldest = std::move(entries_.front());
      entries_.erase(entries_.begin());
    }
    entries_.push_back({typeid(Work), clearance, std::move(erased)});
  }

 private:
  using Erased = std::unique_ptr<void, void (*)(void*)>;
  struct Entry {
    std::type_index type;
    double clearance;
    Erased work;
  };

  Mutex mutex_;
  std::vector<Entry> entries_;
};

}  // namespace microswarm
