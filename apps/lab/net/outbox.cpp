// SPDX-License-Identifier: Apache-2.0
#include "lab/net/outbox.hpp"

#include <algorithm>

namespace microswarm::lab {

void Outbox::add(const MessagePtr& message) {
  if (message->kind == Message::Kind::hello) {
    std::erase_if(waiting_, [&](const MessagePtr& one) {
      if (one->is_latest_only()) size_ -= one->bytes.size();
      return one->is_latest_only();
    });
  }
  size_ += message->bytes.size();
  const auto older = std::ranges::find_if(waiting_, [&](const MessagePtr& one) {
    return message->is_latest_only() && one->kind == message->kind;
  });
  if (older == waiting_.end()) {
    waiting_.push_back(message);
  } else {
    size_ -= (*older)->bytes.size();
    *older = message;
  }
}

MessagePtr Outbox::take() {
  if (waiting_.empty()) return nullptr;
  MessagePtr first = std::move(waiting_.front());
  waiting_.pop_front();
  size_ -= first->bytes.size();
  return first;
}

}  // namespace microswarm::lab
