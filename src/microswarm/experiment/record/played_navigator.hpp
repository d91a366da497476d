// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "microswarm/contracts/navigator.hpp"
#include "microswarm/experiment/record/record.hpp"

namespace microswarm {

/// Commands what a record's navigator commanded at the same times: stands in for a navigator that
/// is not of this library when its run is replayed.
class PlayedNavigator final : public Navigator {
 public:
  /// `record` must outlive it.
  explicit PlayedNavigator(const Record& record) : record_(record) {}

  Command step(const Observation& seen, const Stop& stop) override;
  NavigatorView view() const override { return view_; }

 private:
  const Record& record_;
  std::size_t frame_ = 0;
  std::size_t path_ = 0;  ///< paths that were followed by then
  std::size_t plan_ = 0;  ///< planning events by then
  std::size_t goal_ = 0;  ///< phased goals by then
  NavigatorView view_;
};

}  // namespace microswarm
