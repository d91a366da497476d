// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "microswarm/rig/session/live_session.hpp"
#include "rig/keys/key_input.hpp"

namespace microswarm::cli {

/// Operates a session by keys: p pauses and resumes, m toggles manual steering, arrows or w, a, s,
/// d steer, + and - set the speed, q ends.
class RigOperator {
 public:
  /// Description of the keys for note_how_to_stop().
  static constexpr const char* keys =
      "; q: end, p: pause, m: by hand with the arrow keys, + and -: speed";

  /// The session must outlive the operator.
  explicit RigOperator(rig::LiveSession& session);
  /// To be called from one thread.
  void press(const Key& key);

 private:
  void press(char key);
  void steer(double degrees);

  experiment::Operation& operation_;
  double share_ = 0.5;  // share of the swarm's maximum speed
};

}  // namespace microswarm::cli
