// SPDX-License-Identifier: Apache-2.0
#include "lab/hub.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace microswarm::lab {

Hub::Hub(Post post, std::size_t max_sessions, std::size_t max_pages)
    : post_(std::move(post)), max_sessions_(max_sessions), max_pages_(max_pages) {}

Hub::~Hub() = default;

void Hub::open(Opening opening,
               std::function<void(std::uint64_t, const std::string&)> opened) {
  if (sessions_.size() >= max_sessions_) {
    opened(0, fmt::format("{} sessions are open, which is the limit: close one", max_sessions_));
    return;
  }
  const std::uint64_t number = next_++;
  waiting_[number] = std::move(opened);
  sessions_[number].thread = std::make_unique<SessionThread>(
      std::move(opening),
      SessionThread::Callbacks{
          .opened =
              [this, number](const std::string& trouble) {
                post_([this, number, trouble] { settle(number, trouble); });
              },
          .send =
              [this, number](std::uint64_t page, MessagePtr message) {
                post_([this, number, page, message = std::move(message)] {
                  deliver(number, page, message);
                });
              }});
}

void Hub::settle(std::uint64_t session, const std::string& trouble) {
  const auto opened = std::move(waiting_[session]);
  waiting_.erase(session);
  if (!trouble.empty())
    sessions_.erase(session);
  else if (const auto found = sessions_.find(session); found != sessions_.end())
    found->second.is_open = true;
  if (opened) opened(trouble.empty() ? session : 0, trouble);
}

bool Hub::has(std::uint64_t session) const {
  const auto found = sessions_.find(session);
  return found != sessions_.end() && found->second.is_open;
}

void Hub::close(std::uint64_t session) { sessions_.erase(session); }

std::uint64_t Hub::join(std::uint64_t session, Page& page) {
  const std::uint64_t number = next_++;
  pages_[number] = {session, &page};
  sessions_.at(session).thread->join(number);
  return number;
}

void Hub::leave(std::uint64_t page) { pages_.erase(page); }

void Hub::ask(std::uint64_t page, Request request) {
  const auto seat = pages_.find(page);
  if (seat == pages_.end()) return;
  const auto session = sessions_.find(seat->second.session);
  if (session != sessions_.end()) session->second.thread->ask(page, std::move(request));
}

void Hub::deliver(std::uint64_t session, std::uint64_t page, const MessagePtr& message) {
  for (const auto& [number, seat] : pages_)
    if (seat.session == session && (page == 0 || page == number)) seat.page->send(message);
}

void Hub::sweep() {
  for (auto at = sessions_.begin(); at != sessions_.end();) {
    auto& [number, running] = *at;
    const bool is_watched = std::ranges::any_of(
        pages_, [&](const auto& page) { return page.second.session == number; });
    running.unwatched = is_watched ? 0 : running.unwatched + 1;
    const bool is_left = running.is_open && running.unwatched >= 2;
    at = is_left ? sessions_.erase(at) : std::next(at);
  }
}

}  // namespace microswarm::lab
