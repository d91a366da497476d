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
constexpr double max_speed = 1e6;    ///< simulated seconds per second

Clock::duration wall_time(double seconds) {
  return std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
}

}  // namespace

SessionThread::SessionThread(Opening opening, Callbacks callbacks)
    : opening_(std::move(opening)), callbacks_(std::move(callbacks)), thread_([this] { run(); }) {}

SessionThread::~SessionThread() {
  end();
  thread_.join();
}

void SessionThread::end() {
  ends_ = true;
  const std::lock_guard lock(mutex_);
  wake_.notify_all();
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
  std::string trouble;
  try {
    open();
  } catch (const std::exception& error) {
    trouble = error.what();
    if (trouble.empty()) trouble = "it cannot be opened";
  }
  callbacks_.opened(trouble);
  while (trouble.empty() && !ends_) {
    try {
      serve();
    } catch (const std::exception& error) {
      standing_.plays = false;
      standing_.ended = true;
      standing_.trouble = error.what();
      tell_standing();
    }
  }
  has_ended_ = true;
}

/// What was asked, the tick that is due, and what they changed.
void SessionThread::serve() {
  std::vector<std::function<void()>> work;
  {
    std::unique_lock lock(mutex_);
    const bool is_due = standing_.plays && !standing_.ended;
    const auto wakes = [this] { return ends_ || !work_.empty(); };
    if (!is_due && !is_fresh_)
      wake_.wait(lock, wakes);
    else if (!is_due || standing_.speed > 0)
      wake_.wait_until(lock, next_act(is_due), wakes);
    work.swap(work_);
  }
  for (const auto& one : work) one();
  if (standing_.plays && !standing_.ended && Clock::now() >= due_) advance();
  publish();
}

/// When the next tick is due, or a frame that waits may be published.
Stop::Clock::time_point SessionThread::next_act(bool is_due) const {
  const auto publishes = published_ + frame_period;
  if (!is_due) return publishes;
  return is_fresh_ ? std::min(due_, publishes) : due_;
}

void SessionThread::open() {
  if (opening_.check) opening_.check(opening_.options.settings);
  session_ = open_session(opening_.file, opening_.options);
  past_.reset();
  rows_.clear();
  events_.clear();
  told_plans_ = 0;
  told_aggregation_ = false;
  standing_ = {.speed = standing_.speed};
  if (session_->is_playback()) take_record();
  told_rows_ = rows_.size();
  told_events_ = events_.size();
  is_fresh_ = true;
}

void SessionThread::take_record() {
  const Record& record = session_->record();
  for (const Frame& frame : record.frames) rows_.push_back(row_of({.frame = frame}));
  const auto& steps = record.result.timing.steps;
  for (std::size_t i = 0; i < std::min(rows_.size(), steps.size()); ++i)
    rows_[i].step_time = steps[i];
  events_ = record.events;
  standing_.frames = record.frames.size();
  session_->seek(0);
}

/// The frame that is shown. In a simulation the obstacles are those of the scenario as it is now,
/// so that they are seen before the first tick and after a change.
SessionView SessionThread::present_view() const {
  SessionView view = shown().view();
  if (past_ || session_->is_playback() || !opening_.options.rig.empty()) return view;
  const Scenario& scenario = session_->scenario();
  view.bodies.clear();
  for (std::size_t i = 0; i < scenario.obstacles.size(); ++i)
    append_bodies(scenario.obstacles[i], static_cast<std::uint32_t>(i), view.frame.t, view.bodies);
  if (rows_.empty() && !scenario.robots) view.frame.radius = limits_of(scenario.swarm).radius;
  return view;
}

void SessionThread::welcome(std::uint64_t page) {
  tell_rows();
  callbacks_.send(page, hello_message(*session_, {.file = opening_.file.string(),
                                                  .rig = opening_.options.rig.string(),
                                                  .settings = opening_.options.settings,
                                                  .rig_settings = opening_.options.rig_settings}));
  callbacks_.send(page, rows_message(rows_, events_, true));
  const SessionView view = present_view();
  if (!view.tree.empty()) callbacks_.send(page, plan_message(view));
  if (const auto aggregation = shown().aggregation())
    callbacks_.send(page, aggregation_message(*aggregation));
  standing_.frame = view.number;
  callbacks_.send(page, frame_message(view));
  callbacks_.send(page, standing_message(standing_, session_->result()));
}

void SessionThread::answer(std::uint64_t page, const Request& request) {
  Issues issues;
  try {
    obey(request, issues);
    if (request.ask == Ask::clearance) callbacks_.send(page, clearance_message(session_->map()));
  } catch (const std::exception& error) {
    issues.add_lines({}, error.what());
  }
  has_changed_ = true;
  callbacks_.send(page, answer_message(request.id, issues));
}

void SessionThread::obey(const Request& request, Issues& issues) {
  switch (request.ask) {
    case Ask::play:
      play();
      break;
    case Ask::pause:
      standing_.plays = false;
      break;
    case Ask::step:
      standing_.plays = false;
      look_at_newest();
      advance();
      break;
    case Ask::speed:
      if (request.number < 0 || request.number > max_speed)
        issues.add("number", "the speed is 0 to 1e6 simulated seconds a second");
      else
        standing_.speed = request.number;
      due_ = Clock::now();
      break;
    case Ask::seek:
      look_back(request.number, issues);
      break;
    case Ask::live:
      look_at_newest();
      break;
    case Ask::set:
      set(request, issues);
      break;
    case Ask::restart:
      restart(request);
      break;
    case Ask::clearance:
      break;  // answered by a message
    case Ask::hold:
    case Ask::manual:
    case Ask::steer:
    case Ask::end:
      operate(request, issues);
      break;
  }
}

/// A record that was played to its end begins again.
void SessionThread::play() {
  look_at_newest();
  if (session_->is_playback() && standing_.ended) {
    session_->seek(0);
    standing_.ended = false;
  }
  standing_.plays = !standing_.ended;
  due_ = Clock::now();
}

void SessionThread::set(const Request& request, Issues& issues) {
  issues = session_->set(request.key, request.value);
  if (!issues.empty()) return;
  std::erase_if(standing_.changes,
                [&](const std::string& one) { return one.starts_with(request.key + "="); });
  standing_.changes.push_back(request.key + "=" + request.value);
  callbacks_.send(0, scenario_message(session_->scenario()));
  is_fresh_ = true;
}

void SessionThread::restart(const Request& request) {
  auto before = opening_.options.settings;
  opening_.options.settings = request.settings;
  try {
    open();
  } catch (...) {
    opening_.options.settings = std::move(before);
    throw;
  }
  welcome(0);
}

void SessionThread::operate(const Request& request, Issues& issues) {
  Operation* operation = session_->operation();
  if (!operation)
    issues.add({}, "a record is not steered");
  else if (request.ask == Ask::hold)
    operation->pause(request.on);
  else if (request.ask == Ask::manual)
    operation->manual(request.on);
  else if (request.ask == Ask::steer)
    operation->steer({.heading = request.heading, .speed = request.speed});
  else
    operation->end();
}

void SessionThread::advance() {
  const Stop stop(&ends_);
  const auto began = Clock::now();
  do {
    const Tick* tick = session_->step(stop);
    if (tick) take(*tick);
    standing_.ended = !tick || tick->end;
    if (standing_.speed > 0) due_ += wall_time(session_->scenario().tick / standing_.speed);
  } while (standing_.plays && !standing_.ended && !ends_ && standing_.speed <= 0 &&
           Clock::now() < began + frame_period / 2);
  due_ = std::max(due_, Clock::now() - longest_lag);
  if (!standing_.ended) return;
  standing_.plays = false;
  has_changed_ = true;
}

void SessionThread::take(const Tick& tick) {
  is_fresh_ = true;
  if (session_->is_playback()) return;
  rows_.push_back(row_of(tick));
  events_.insert(events_.end(), tick.events.begin(), tick.events.end());
  standing_.frames = rows_.size();
}

void SessionThread::look_back(double frame, Issues& issues) {
  if (frame < 0 || frame > 1e15 || rows_.empty()) {
    issues.add("number", "there is no such frame");
    return;
  }
  const auto number = static_cast<std::size_t>(frame);
  if (session_->is_playback()) {
    session_->seek(number);
    standing_.ended = false;
  } else {
    if (!past_) past_ = std::make_unique<Session>(Record(session_->record()));
    past_->seek(number);
    standing_.looks_back = true;
    standing_.plays = false;
  }
  is_fresh_ = true;
}

void SessionThread::look_at_newest() {
  if (past_) is_fresh_ = true;
  past_.reset();
  standing_.looks_back = false;
}

void SessionThread::publish() {
  if (is_fresh_ && Clock::now() >= published_ + frame_period) {
    is_fresh_ = false;
    has_changed_ = true;
    published_ = Clock::now();
    tell_rows();
    const SessionView view = present_view();
    if (view.plans != told_plans_) callbacks_.send(0, plan_message(view));
    told_plans_ = view.plans;
    if (!told_aggregation_ && !past_) {
      if (const auto aggregation = session_->aggregation()) {
        callbacks_.send(0, aggregation_message(*aggregation));
        told_aggregation_ = true;
      }
    }
    standing_.frame = view.number;
    callbacks_.send(0, frame_message(view));
  }
  if (has_changed_) tell_standing();
}

void SessionThread::tell_rows() {
  if (told_rows_ == rows_.size() && told_events_ == events_.size()) return;
  callbacks_.send(0, rows_message(std::span(rows_).subspan(told_rows_),
                                  std::span(events_).subspan(told_events_), false));
  told_rows_ = rows_.size();
  told_events_ = events_.size();
}

void SessionThread::tell_standing() {
  has_changed_ = false;
  if (const Operation* operation = session_->operation()) standing_.mode = operation->mode();
  callbacks_.send(0, standing_message(standing_, session_->result()));
}

}  // namespace microswarm::lab
