// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "microswarm/session/live_session.hpp"
#include "rig/keys/key_input.hpp"

namespace microswarm::cli {

/// Operates a session by keys: p pauses and resumes, m takes over and gives back, arrows or w, a,
/// s, d steer, + and - set the speed, q ends.
class RigOperator {
 public:
  /// What note_how_to_stop() says of them.
  static constexpr const char* keys =
      "; q: end, p: pause, m: by hand with the arrow keys, + and -: speed";

  /// The session must outlive it.
  explicit RigOperator(LiveSession& session);
  /// Called in any one thread.
  void press(const Key& key);

 private:
  void press(char key);
  void steer(double degrees);

  Operation& operation_;
  double share_ = 0.5;  // of the swarm's speed
};

}  // namespace microswarm::cli
