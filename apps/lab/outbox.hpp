// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <deque>

#include "lab/stream.hpp"

namespace microswarm::lab {

/// Messages that wait to be written to a page, in order. A newer frame or standing takes the place
/// of one that still waits, so that a slow page loses frames and never another message; a hello
/// makes earlier frames obsolete.
class Outbox {
 public:
  void add(const MessagePtr& message);
  /// The next one; null if there is none.
  MessagePtr take();
  /// Of all that waits [bytes].
  std::size_t size() const { return size_; }

 private:
  std::deque<MessagePtr> waiting_;
  std::size_t size_ = 0;
};

}  // namespace microswarm::lab
