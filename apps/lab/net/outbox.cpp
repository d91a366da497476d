// SPDX-License-Identifier: Apache-2.0
#include "lab/net/outbox.hpp"

#include <algorithm>

namespace microswarm::lab {

void Outbox::add(const MessagePtr& message) {
  using enum Message::Kind;
  if (message->kind == hello)
    std::erase_if(waiting_, [&](const MessagePtr& one) {
      if (one->is_latest_only()) size_ -= one->bytes.size();
      return one->is_latest_only();
    });
  if (message->kind == standing) drop_standing();
  const auto older = std::ranges::find_if(waiting_, [&](const MessagePtr& one) {
    return message->is_latest_only() && message->kind != standing && one->kind == message->kind;
  });
  size_ += message->bytes.size();
  if (older == waiting_.end()) {
    waiting_.push_back(message);
  } else {
    size_ -= (*older)->bytes.size();
    *older = message;
  }
}

/// Drops the last standing if no answer follows it. The first one stays, so that a page that is
/// always behind gets some.
void Outbox::drop_standing() {
  auto last = waiting_.end();
  std::size_t standings = 0;
  for (auto one = waiting_.begin(); one != waiting_.end(); ++one) {
    if ((*one)->kind == Message::Kind::standing) last = one, ++standings;
    if ((*one)->kind == Message::Kind::answer) last = waiting_.end();
  }
  if (last == waiting_.end() || standings < 2) return;
  size_ -= (*last)->bytes.size();
  waiting_.erase(last);
}

MessagePtr Outbox::take() {
  if (waiting_.empty()) return nullptr;
  MessagePtr first = std::move(waiting_.front());
  waiting_.pop_front();
  size_ -= first->bytes.size();
  return first;
}

}  // namespace microswarm::lab
