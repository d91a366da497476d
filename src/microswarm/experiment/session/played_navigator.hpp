// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "microswarm/contracts/navigator.hpp"
#include "microswarm/experiment/record/record.hpp"

namespace microswarm::experiment {

/// Repeats the commands of a record's navigator at the same times. It replaces an external
/// navigator when its run is replayed.
class PlayedNavigator final : public Navigator {
 public:
  /// `record` must outlive it.
  explicit PlayedNavigator(const Record& record) : record_(record) {}

  Command step(const Observation& seen, const Stop& stop) override;
  NavigatorView view() const override { return view_; }
  Diagnostics diagnostics() const override;

 private:
  const Record& record_;
  std::size_t frame_ = 0;
  std::size_t path_ = 0;  ///< number of paths followed so far
  std::size_t plan_ = 0;  ///< number of planning events so far
  std::size_t goal_ = 0;  ///< number of phased goals so far
  NavigatorView view_;
};

}  // namespace microswarm::experiment
