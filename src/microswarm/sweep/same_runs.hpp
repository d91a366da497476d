// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>

#include "microswarm/sweep/table.hpp"

namespace microswarm::sweep {

/// Finds the trials of a sweep that are the same run, since nothing in their scenario is random.
/// Trials are compared if they differ in their number and seed alone.
class SameRuns {
 public:
  explicit SameRuns(const std::vector<SweepColumn>& columns);
  void add(std::span<const SqlValue> row);
  /// One line if all trials of a combination, at least two, are the same run; else empty.
  std::string note() const;

 private:
  struct Combination {
    std::size_t trials = 0;
    std::string record_hash;
    bool same = true;
  };

  std::vector<std::size_t> settings_;  ///< columns of method and parameters, without the seed
  std::size_t record_hash_ = 0;
  std::map<std::vector<SqlValue>, Combination> combinations_;
};

}  // namespace microswarm::sweep
