// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "microswarm/rig/identify/response_data.hpp"

namespace microswarm::rig {

/// Path of a swarm that answers the field at once and as the rig's file says: the commands, with
/// the turns of the heading, the changes of the pitch and the limits of the field generator.
class DrivenPath {
 public:
  /// Ends `after` [s] behind the last command. A path is limited to 2,000,000 steps of 5 ms; the
  /// swarm rests afterwards.
  DrivenPath(const actuation::FieldGeneratorParams& field, std::span<const DrivenCommand> commands,
             double after);

  /// Displacement since the first command [µm]; zero before it.
  Vec2 at(double t) const;
  double length() const { return length_; }  ///< [µm]

 private:
  double begin_ = 0;
  double length_ = 0;
  std::vector<Vec2> points_;
};

}  // namespace microswarm::rig
