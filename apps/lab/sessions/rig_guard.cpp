// SPDX-License-Identifier: Apache-2.0
#include "lab/sessions/rig_guard.hpp"

#include <fmt/format.h>

#include <optional>
#include <utility>

#include "microswarm/core/execution/priority.hpp"

namespace microswarm::lab {

RigGuard::~RigGuard() {
  {
    const std::lock_guard lock(mutex_);
    ends_ = true;
    changed_.notify_all();
  }
  thread_.join();
}

void RigGuard::beat() {
  const std::lock_guard lock(mutex_);
  heard_ = Clock::now();
}

bool RigGuard::hears() const {
  const std::lock_guard lock(mutex_);
  return Clock::now() < heard_ + patience;
}

void RigGuard::stop(const std::string& why, rig::FaultKind kind) {
  const std::lock_guard lock(mutex_);
  ++stops_;
  last_kind_ = kind;
  if (!session_) return;
  why_ = {why, kind};
  changed_.notify_all();
}

std::uint64_t RigGuard::stops() const {
  const std::lock_guard lock(mutex_);
  return stops_;
}

void RigGuard::watch(std::shared_ptr<rig::LiveSession> session, bool listens, std::uint64_t stops,
                     int priority) {
  const std::lock_guard lock(mutex_);
  priority_ = priority;
  session_ = std::move(session);
  listens_ = listens;
  if (listens) heard_ = Clock::now();  // no current was sent so far
  if (stops_ != stops) why_ = {"it was stopped while it was opened", last_kind_};
  changed_.notify_all();
}

void RigGuard::release() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return !is_stopping_; });
  session_.reset();
  why_ = {};
  listens_ = false;
}

void RigGuard::run() {
  std::optional<RealtimePriority> priority;
  std::unique_lock lock(mutex_);
  while (!ends_) {
    if (priority_ > realtime_priority()) priority.emplace(priority_);
    if (session_ && why_.why.empty() && listens_ && Clock::now() >= heard_ + patience) {
      ++stops_;
      last_kind_ = rig::FaultKind::person;
      why_ = {fmt::format("no word from the page for {:.1f} s",
                          std::chrono::duration<double>(patience).count()),
              rig::FaultKind::person};
    }
    if (session_ && !why_.why.empty()) {
      auto session = session_;
      const rig::Fault why = std::exchange(why_, {});
      listens_ = false;
      is_stopping_ = true;
      lock.unlock();
      session->stop(why.why, why.kind);
      session.reset();  // not the last owner of its devices
      lock.lock();
      is_stopping_ = false;
      changed_.notify_all();
    } else if (session_ && listens_) {
      changed_.wait_until(lock, heard_ + patience);
    } else {
      changed_.wait(lock);
    }
  }
}

}  // namespace microswarm::lab
