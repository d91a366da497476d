// SPDX-License-Identifier: Apache-2.0
#include "lab/sessions/hub.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "lab/sessions/make_host.hpp"

namespace microswarm::lab {

Hub::Hub(Post post, const Limits& limits) : post_(std::move(post)), limits_(limits) {}

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

void Hub::leave(std::uint64_t page) {
  const auto seat = pages_.extract(page);
  if (!seat) return;
  const auto session = sessions_.find(seat.mapped().session);
  if (session != sessions_.end()) session->second.host->leave(page);
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

/// Closes the longest unwatched sessions while all unwatched ones take too much memory.
void Hub::close_largest() {
  std::size_t bytes = 0;
  std::ptrdiff_t count = 0;
  for (const auto& [number, running] : sessions_)
    if (running.unwatched >= 2) bytes += running.host->bytes(), ++count;
  for (; bytes > limits_.kept && count > 1; --count) {
    const auto longest = std::ranges::max_element(
        sessions_, {}, [](const auto& one) { return one.second.unwatched; });
    bytes -= longest->second.host->bytes();
    close(longest->first);
  }
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

/// Closes the session that is unwatched for the longest time, never one on a rig.
void Hub::close_unwatched() {
  auto longest = sessions_.end();
  for (auto it = sessions_.begin(); it != sessions_.end(); ++it) {
    const auto& [number, running] = *it;
    if (!makes_room(number)) continue;
    if (longest == sessions_.end() || running.unwatched > longest->second.unwatched) longest = it;
  }
  if (longest != sessions_.end()) close(longest->first);
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
