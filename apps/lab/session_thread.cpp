// SPDX-License-Identifier: Apache-2.0
#include "lab/session_thread.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "microswarm/core/errors/error.hpp"

namespace microswarm::lab {
namespace {

using Clock = Stop::Clock;
using namespace std::chrono_literals;

constexpr auto frame_period = 33ms;
constexpr auto longest_lag = 250ms;  ///< of simulated time; what is more is not made up for

Clock::duration wall_time(double seconds) {
  return std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
}

}  // namespace

SessionThread::SessionThread(Opening opening, Callbacks callbacks)
    : opening_(std::move(opening)),
      callbacks_(std::move(callbacks)),
      thread_([this] { run(); }) {}

SessionThread::~SessionThread() {
  ended_ = true;
  {
    const std::lock_guard lock(mutex_);
    wake_.notify_all();
  }
  thread_.join();
}

void SessionThread::join(std::uint64_t page) {
  with([this, page](Session&) { welcome(page); });
}

void SessionThread::ask(std::uint64_t page, Request request) {
  with([this, page, request = std::move(request)](Session&) { answer(page, request); });
}

void SessionThread::with(std::function<void(Session&)> work) {
  const std::lock_guard lock(mutex_);
  work_.push_back([this, work = std::move(work)] { work(*session_); });
  wake_.notify_all();
}

void SessionThread::run() {
  try {
    open();
  } catch (const std::exception& error) {
    callbacks_.opened(error.what());
    return;
  }
  callbacks_.opened({});
  while (!ended_) {
    std::vector<std::function<void()>> work;
    {
      std::unique_lock lock(mutex_);
      const bool is_due = standing_.plays && !standing_.ended;
      const auto wakes = [this] { return ended_ || !work_.empty(); };
      if (!is_due && !is_fresh_)
        wake_.wait(lock, wakes);
      else if (!is_due || standing_.speed > 0)
        wake_.wait_until(lock, is_due ? due_ : published_ + frame_period, wakes);
      work.swap(work_);
    }
    for (const auto& one : work) one();
    if (standing_.plays && !standing_.ended && Clock::now() >= due_) advance();
    publish(false);
  }
}

void SessionThread::open() {
  session_ = open_session(opening_.file, opening_.options);
  past_.reset();
  rows_.clear();
  events_.clear();
  told_rows_ = told_events_ = 0;
  told_plans_ = 0;
  told_aggregation_ = false;
  standing_ = {.speed = standing_.speed};
  if (session_->is_playback()) {
    const Record& record = session_->record();
    for (const Frame& frame : record.frames) rows_.push_back(row_of({.frame = frame}));
    const auto& steps = record.result.timing.steps;
    for (std::size_t i = 0; i < std::min(rows_.size(), steps.size()); ++i)
      rows_[i].step_time = steps[i];
    events_ = record.events;
    standing_.frames = record.frames.size();
    session_->seek(0);
  }
  is_fresh_ = true;
}

void SessionThread::tell_scenario(std::uint64_t page) {
  const std::string command = "microswarm run " + opening_.file.string();
  callbacks_.send(page, hello_message(*session_, opening_.file.string(), command));
}

void SessionThread::welcome(std::uint64_t page) {
  tell_scenario(page);
  callbacks_.send(page, rows_message(rows_, events_, true));
  const SessionView view = shown().view();
  if (!view.tree.empty()) callbacks_.send(page, plan_message(view));
  if (const auto aggregation = shown().aggregation())
    callbacks_.send(page, aggregation_message(*aggregation));
  callbacks_.send(page, frame_message(view));
  callbacks_.send(page, standing_message(standing_, session_->result()));
}

void SessionThread::answer(std::uint64_t page, const Request& request) {
  Issues issues;
  try {
    issues = obey(request);
    if (request.ask == Ask::clearance)
      callbacks_.send(page, clearance_message(session_->map()));
  } catch (const InputError& error) {
    issues.add_lines({}, error.what());
  }
  callbacks_.send(page, answer_message(request.id, issues));
  tell_standing();
}

Issues SessionThread::obey(const Request& request) {
  Issues issues;
  Operation* operation = session_->operation();
  const bool operates = request.ask == Ask::hold || request.ask == Ask::manual ||
                        request.ask == Ask::steer || request.ask == Ask::end;
  if (operates && !operation) {
    issues.add({}, "a record is not steered");
    return issues;
  }
  switch (request.ask) {
    case Ask::play:
      past_.reset();
      standing_.looks_back = false;
      standing_.plays = true;
      due_ = Clock::now();
      break;
    case Ask::pause: standing_.plays = false; break;
    case Ask::step:
      standing_.plays = false;
      past_.reset();
      standing_.looks_back = false;
      advance();
      break;
    case Ask::speed:
      if (request.number < 0 || request.number > 1e6)
        issues.add("number", "the speed is 0 to 1e6 simulated seconds a second");
      else
        standing_.speed = request.number;
      due_ = Clock::now();
      break;
    case Ask::seek:
      if (!(request.number >= 0 && request.number < 1e15))
        issues.add("number", "there is no such frame");
      else
        look_back(static_cast<std::size_t>(request.number));
      break;
    case Ask::live:
      past_.reset();
      standing_.looks_back = false;
      is_fresh_ = true;
      break;
    case Ask::set:
      issues = session_->set(request.key, request.value);
      if (issues.empty() && !session_->is_playback()) {
        standing_.changes.push_back(request.key + "=" + request.value);
        tell_scenario(0);
      }
      break;
    case Ask::restart: {
      const auto before = opening_.options.settings;
      opening_.options.settings = request.settings;
      try {
        open();
      } catch (const InputError&) {
        opening_.options.settings = before;
        throw;
      }
      welcome(0);
      break;
    }
    case Ask::hold: operation->pause(request.on); break;
    case Ask::manual: operation->manual(request.on); break;
    case Ask::steer: operation->steer({.heading = request.heading, .speed = request.speed}); break;
    case Ask::end: operation->end(); break;
    case Ask::clearance: break;  // `answer` sends it
  }
  return issues;
}

void SessionThread::advance() {
  const Stop stop(&ended_);
  const auto began = Clock::now();
  do {
    const Tick* tick = session_->step(stop);
    if (!tick) {
      standing_.plays = false;
      standing_.ended = true;
      tell_standing();
      return;
    }
    take(*tick);
    if (tick->end) standing_.ended = true;
    if (standing_.speed > 0) due_ += wall_time(session_->scenario().tick / standing_.speed);
  } while (!standing_.ended && standing_.speed <= 0 && Clock::now() < began + frame_period / 2);
  due_ = std::max(due_, Clock::now() - longest_lag);
  if (standing_.ended) {
    standing_.plays = false;
    tell_standing();
  }
}

void SessionThread::take(const Tick& tick) {
  is_fresh_ = true;
  if (session_->is_playback()) return;
  rows_.push_back(row_of(tick));
  events_.insert(events_.end(), tick.events.begin(), tick.events.end());
  standing_.frames = rows_.size();
}

void SessionThread::look_back(std::size_t frame) {
  if (session_->is_playback()) {
    session_->seek(frame);
    standing_.ended = false;
  } else if (!rows_.empty()) {
    if (!past_) past_ = std::make_unique<Session>(Record(session_->record()));
    past_->seek(frame);
    standing_.looks_back = true;
    standing_.plays = false;
  }
  is_fresh_ = true;
}

void SessionThread::publish(bool at_once) {
  if (!is_fresh_ || (!at_once && Clock::now() < published_ + frame_period)) return;
  is_fresh_ = false;
  published_ = Clock::now();
  if (told_rows_ < rows_.size() || told_events_ < events_.size()) {
    callbacks_.send(0, rows_message(std::span(rows_).subspan(told_rows_),
                                    std::span(events_).subspan(told_events_), false));
    told_rows_ = rows_.size();
    told_events_ = events_.size();
  }
  const SessionView view = shown().view();
  if (view.plans != told_plans_) {
    callbacks_.send(0, plan_message(view));
    told_plans_ = view.plans;
  }
  if (!told_aggregation_ && !past_) {
    if (const auto aggregation = session_->aggregation()) {
      callbacks_.send(0, aggregation_message(*aggregation));
      told_aggregation_ = true;
    }
  }
  standing_.frame = view.number;
  callbacks_.send(0, frame_message(view));
  tell_standing();
}

void SessionThread::tell_standing() {
  if (const Operation* operation = session_->operation()) standing_.mode = operation->mode();
  callbacks_.send(0, standing_message(standing_, session_->result()));
}

}  // namespace microswarm::lab
