// SPDX-License-Identifier: Apache-2.0
#include "lab/sessions/hub.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "lab/sessions/make_host.hpp"

namespace microswarm::lab {

Hub::Hub(Post post, const Limits& limits, std::uint64_t lab)
    : post_(std::move(post)), limits_(limits), lab_(lab) {}

void Hub::open(Opening opening, std::function<void(const Outcome<std::uint64_t>&)> opened) {
  const auto spare = static_cast<std::size_t>(
      std::ranges::count_if(sessions_, [this](const auto& one) { return makes_room(one.first); }));
  if (sessions_.size() - spare >= limits_.sessions || closing_.size() >= limits_.sessions)
    return opened({.trouble = fmt::format("{} sessions are open, which is the limit: close one",
                                          limits_.sessions)});
  if (opening.live)
    for (const auto& [number, running] : sessions_)
      if (running.host->opening().live)
        return opened(
            {.value = number, .trouble = running.is_open ? "" : "the rig is being opened"});
  // The devices serve one session at a time.
  if (opening.live && std::ranges::any_of(closing_, [](const auto& host) {
        return host->opening().live && !host->has_ended();
      }))
    return opened({.trouble = "the rig is being closed: try again"});
  const std::uint64_t number = next_++;
  const std::uint64_t waits =
      wait(number, [this, number, opened = std::move(opened)](const std::string& trouble) {
        const auto found = sessions_.find(number);
        if (found != sessions_.end() && trouble.empty()) {
          if (sessions_.size() > limits_.sessions) close_unwatched();  // now that it has opened
          found->second.is_open = true;
        }
        if (!trouble.empty()) close(number);
        opened({.value = number, .trouble = trouble});
      });
  sessions_[number].host =
      make_host(std::move(opening),
                Host::Callbacks{.opened =
                                    [this, waits](const std::string& trouble) {
                                      post_([this, waits, trouble] { settle(waits, trouble); });
                                    },
                                .send =
                                    [this, number](std::uint64_t page, MessagePtr message) {
                                      post_([this, number, page, message = std::move(message)] {
                                        deliver(number, page, message);
                                      });
                                    }});
}

bool Hub::has(std::uint64_t session) const {
  const auto found = sessions_.find(session);
  return found != sessions_.end() && found->second.is_open;
}

void Hub::close(std::uint64_t session) {
  const auto found = sessions_.find(session);
  if (found == sessions_.end()) return;
  found->second.host->end();
  closing_.push_back(std::move(found->second.host));
  sessions_.erase(found);
  std::vector<std::shared_ptr<Page>> left;
  for (const auto& [number, seat] : pages_)
    if (seat.session == session) left.push_back(seat.page);
  for (const auto& page : left) page->close();
  std::vector<std::uint64_t> waiting;
  for (const auto& [number, one] : waiting_)
    if (one.session == session) waiting.push_back(number);
  for (const std::uint64_t number : waiting) settle(number, "the session was closed");
}

std::uint64_t Hub::wait(std::uint64_t session, std::function<void(const std::string&)> settle) {
  const std::uint64_t number = next_++;
  waiting_[number] = {session, std::move(settle)};
  return number;
}

void Hub::settle(std::uint64_t waiting, const std::string& trouble) {
  auto one = waiting_.extract(waiting);
  if (one) one.mapped().settle(trouble);
}

std::uint64_t Hub::join(std::uint64_t session, std::shared_ptr<Page> page) {
  const std::uint64_t number = next_++;
  pages_[number] = {session, std::move(page)};
  sessions_.at(session).host->join(number);
  return number;
}

void Hub::leave(std::uint64_t page, bool for_good) {
  const auto seat = pages_.extract(page);
  if (!seat) return;
  const auto session = sessions_.find(seat.mapped().session);
  if (session == sessions_.end()) return;
  session->second.host->leave(page);
  if (for_good && !is_watched(session->first)) session->second.host->rest();
}

void Hub::stop(const std::string& why) {
  for (const auto& [number, running] : sessions_) running.host->stop(why);
}

void Hub::ask(std::uint64_t page, Request request) {
  const auto seat = pages_.find(page);
  if (seat == pages_.end()) return;
  const auto session = sessions_.find(seat->second.session);
  if (session != sessions_.end()) session->second.host->ask(page, std::move(request));
}

void Hub::deliver(std::uint64_t session, std::uint64_t page, const MessagePtr& message) {
  std::vector<std::shared_ptr<Page>> to;  // a page may leave during the call
  for (auto& [number, seat] : pages_) {
    if (page == number) seat.is_welcome = true;
    if (seat.session == session && (page == number || (page == 0 && seat.is_welcome)))
      to.push_back(seat.page);
  }
  for (const auto& one : to) one->send(message);
}

void Hub::sweep() {
  std::vector<std::uint64_t> left;
  for (auto& [number, running] : sessions_) {
    running.unwatched = is_watched(number) || !running.is_open ? 0 : running.unwatched + 1;
    if (running.unwatched == 2) running.host->rest();
    const bool is_live = running.host->opening().live.has_value();
    if (running.unwatched >= 2 &&
        (is_live || running.unwatched * limits_.sweep_period >= limits_.keep))
      left.push_back(number);
  }
  for (const std::uint64_t number : left) close(number);
  close_largest();
}

/// Closes unwatched sessions while all of them take too much memory.
void Hub::close_largest() {
  std::size_t bytes = 0;
  std::vector<Session> left;
  left.reserve(sessions_.size());
  for (auto it = sessions_.begin(); it != sessions_.end(); ++it) {
    if (it->second.unwatched < 2) continue;
    bytes += it->second.host->bytes();
    left.push_back(it);
  }
  std::ranges::sort(left, [this](Session a, Session b) { return goes_before(a, b); });
  for (std::size_t i = 0; bytes > limits_.kept && i + 1 < left.size(); ++i) {
    bytes -= left[i]->second.host->bytes();
    close(left[i]->first);
  }
}

/// Whether `a` is closed before `b`: what can be opened again, then what is unwatched for longer.
bool Hub::goes_before(Session a, Session b) const {
  const auto rank = [](Session one) {
    return std::make_pair(one->second.host->is_changed(), -one->second.unwatched);
  };
  return rank(a) < rank(b);
}

std::vector<Hub::Open> Hub::open_sessions() const {
  std::vector<Open> list;
  list.reserve(sessions_.size());
  for (const auto& [number, running] : sessions_)
    if (running.is_open)
      list.push_back({.session = number,
                      .file = running.host->opening().file.string(),
                      .newest = running.host->newest(),
                      .watched = is_watched(number),
                      .changed = running.host->is_changed(),
                      .live = running.host->opening().live.has_value()});
  return list;
}

bool Hub::is_watched(std::uint64_t session) const {
  return std::ranges::any_of(pages_,
                             [&](const auto& page) { return page.second.session == session; });
}

/// Whether it is closed for others: it is open, unwatched and not on a rig.
bool Hub::makes_room(std::uint64_t session) const {
  const Running& running = sessions_.at(session);
  return running.is_open && !running.host->opening().live && !is_watched(session);
}

/// Closes an unwatched session, never one on a rig.
void Hub::close_unwatched() {
  auto first = sessions_.end();
  for (auto it = sessions_.begin(); it != sessions_.end(); ++it)
    if (makes_room(it->first) && (first == sessions_.end() || goes_before(it, first))) first = it;
  if (first != sessions_.end()) close(first->first);
}

void Hub::reap() {
  std::erase_if(closing_, [](const auto& host) { return host->has_ended(); });
}

void Hub::end() {
  waiting_.clear();
  pages_.clear();
  for (auto& [number, running] : std::exchange(sessions_, {})) {
    running.host->end();
    closing_.push_back(std::move(running.host));
  }
}

bool Hub::has_ended() const {
  return std::ranges::all_of(closing_, [](const auto& host) { return host->has_ended(); });
}

}  // namespace microswarm::lab
