// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deque>
#include <string>

namespace microswarm::rig {

/// Share of the pictures in which a swarm is not found, over the last seconds.
class UnseenShare {
 public:
  /// Above `max_share` of the pictures of `window` seconds it is a fault; 0: not checked.
  explicit UnseenShare(double max_share, double window = 5)
      : max_share_(max_share), length_(window) {}

  void take(bool is_seen, double t);
  double share() const;                                ///< over the last seconds
  double highest() const { return highest_; }          ///< so far
  int unseen() const { return unseen_; }               ///< pictures so far
  const std::string& fault() const { return fault_; }  ///< why a run must end, or empty
  /// A note, once; empty otherwise.
  std::string take_note();

 private:
  struct Picture {
    double t;
    bool is_seen;
  };
  double max_share_;
  double length_;  // of the window [s]
  std::deque<Picture> window_;
  int unseen_in_window_ = 0;
  double highest_ = 0;
  int unseen_ = 0;
  int pictures_ = 0;
  bool told_ = false;
  std::string fault_;
};

}  // namespace microswarm::rig
