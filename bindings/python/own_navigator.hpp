// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "calls.hpp"
#include "microswarm/contracts/navigator.hpp"

namespace microswarm::python {

/// Obstacles as rows x, y, radius of the circle around each [µm].
py::array_t<double> to_circles(std::span<const Body> bodies);

/// A navigator written in Python, in the library's loop. Its methods are called with the GIL held.
class OwnNavigator final : public Navigator {
 public:
  /// `navigator` has a method step(observation), and may have prepare(). It must outlive this.
  explicit OwnNavigator(py::handle navigator);

  void prepare(const Snapshot& world, const Stop& stop) override;
  Command step(const Observation& seen, const Stop& stop) override;
  NavigatorView view() const override { return {.state = state_, .local_target = {}, .path = {}}; }

 private:
  py::handle navigator_;
  NavigatorState state_ = NavigatorState::hold;
};

}  // namespace microswarm::python
