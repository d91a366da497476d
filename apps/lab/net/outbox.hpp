// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <deque>

#include "lab/stream/stream.hpp"

namespace microswarm::lab {

/// Queue of messages to a page. A newer frame, picture or rig message replaces one that is still
/// queued, so that a slow page loses frames but no other message; a hello makes earlier frames
/// obsolete. A standing is queued after the rows and answers that it counts, and supersedes the one
/// before it.
class Outbox {
 public:
  void add(const MessagePtr& message);
  /// The next message; null without one.
  MessagePtr take();
  /// Size of the queue [B].
  std::size_t size() const { return size_; }

 private:
  void drop_standing();

  std::deque<MessagePtr> waiting_;
  std::size_t size_ = 0;
};

}  // namespace microswarm::lab
