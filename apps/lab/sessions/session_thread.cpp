// SPDX-License-Identifier: Apache-2.0
#include "lab/sessions/session_thread.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/experiment/session/replay.hpp"

namespace microswarm::lab {
namespace {

using Clock = Stop::Clock;
using namespace std::chrono_literals;

constexpr auto longest_lag =
    250ms;  ///< maximum lag of simulated time; a larger lag is not made up for
constexpr auto look_period = 1s;   ///< period of checks for more of a growing record
constexpr double max_speed = 1e6;  ///< simulated seconds per second

Clock::duration wall_time(double seconds) {
  return std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
}

/// Approximate memory of a record and of the rows made from it [B].
std::size_t bytes_of(const experiment::Record& record) {
  const auto all = [](const auto& list, auto&& bytes_of_one) {
    return list.empty() ? 0 : list.size() * bytes_of_one(list.back());
  };
  return record.frames.size() * (sizeof(experiment::Frame) + sizeof(Row)) +
         all(record.robots, [](const auto& one) { return one.positions.size() * sizeof(Vec2); }) +
         all(record.plans, [](const auto& one) { return one.plan.tree.size() * sizeof(TreeNode); });
}

}  // namespace

void SessionThread::rest() {
  later([this] {
    publisher_.standing.plays = false;
    publisher_.changed();
  });
}

/// Handles requests and the tick that is due, and publishes the changes.
void SessionThread::serve() {
  const Standing& standing = publisher_.standing;
  work_until(next_act(standing.plays && !standing.ended));
  if (standing.growing && Clock::now() >= looks_) look_for_more();
  if (standing.plays && !standing.ended && Clock::now() >= due_) advance();
  publisher_.publish(*session_, shown(), [this] { return present_view(); });
  bytes_ = bytes_of(session_->record()) + kept_.bytes();
  newest_ = publisher_.newest();
  is_changed_ = !session_->is_playback() && (!standing.changes.empty() || standing.steered);
}

/// Time of the next tick, of the next possible frame message, or of the next check of a record.
std::optional<Stop::Clock::time_point> SessionThread::next_act(bool is_due) const {
  const Standing& standing = publisher_.standing;
  std::optional<Clock::time_point> next;
  const auto add = [&next](Clock::time_point other) {
    next = std::min(next.value_or(other), other);
  };
  if (is_due) add(standing.speed > 0 ? due_ : Clock::time_point{});
  if (publisher_.is_fresh()) add(publisher_.next_frame());
  if (standing.growing) add(looks_);
  return next;
}

void SessionThread::open() {
  if (opening_.check) opening_.check(opening_.options.settings);
  if (const auto branch = std::exchange(opening_.branch, {})) return open_branch(*branch);
  watch_.has_changed();
  session_ = open_(watch_.file(), opening_.options);
  look_at_newest();
  publisher_.clear();
  kept_ = Past();
  if (!session_->is_playback()) return;
  publisher_.take(session_->record());
  publisher_.standing.growing = watch_.is_growing();
  looks_ = Clock::now() + look_period;
  session_->seek(publisher_.standing.growing ? publisher_.rows() : 0);
}

void SessionThread::open_branch(const Branch& branch) {
  kept_ = Past();
  session_ = experiment::branch(*branch.record, branch.frame, Stop(&ends_),
                                [this](const experiment::Session& of) { keep(*of.tick(), of); });
  if (!session_) throw std::runtime_error("it was closed");
  publisher_.clear();
  publisher_.take(session_->record());
  for (const std::string& change : branch.changes) {
    const Setting setting = parse_setting(change, "changes");
    Issues issues;
    publisher_.set(*session_, {.key = setting.key, .value = setting.value}, issues);
    if (!issues.empty()) throw InputError(*issues.begin());
  }
}

void SessionThread::look_for_more() {
  Standing& standing = publisher_.standing;
  looks_ = Clock::now() + look_period;
  const bool was_growing = standing.growing;
  try {
    standing.growing = watch_.is_growing();
    if (watch_.has_changed()) grow();
  } catch (const InputError&) {
    standing.growing = true;  // it was replaced meanwhile; the next check finds the new file
  }
  if (standing.growing != was_growing) publisher_.changed();
}

/// Continues with the grown record. A page at the newest frame gets the new one.
void SessionThread::grow() {
  auto longer = open_(watch_.file(), opening_.options);
  if (longer->record().frames.size() < publisher_.rows()) {  // it belongs to another run
    open();
    welcome(0);
    return;
  }
  Standing& standing = publisher_.standing;
  const std::uint64_t shown = session_->view().number;
  const bool is_newest = shown + 1 >= publisher_.rows();
  session_ = std::move(longer);
  publisher_.take_more(session_->record());
  session_->seek(is_newest && !standing.plays ? publisher_.rows() : shown);
  standing.ended = false;
  publisher_.freshen();
}

/// The shown frame. In a simulation the obstacles are those of the current scenario, so that they
/// are visible before the first tick and after a change.
experiment::SessionView SessionThread::present_view() {
  experiment::SessionView view = shown().view();
  if (looks_back() || session_->is_playback() || !opening_.options.rig.empty()) return view;
  const experiment::Scenario& scenario = session_->scenario();
  view.bodies.clear();
  for (std::size_t i = 0; i < scenario.obstacles.size(); ++i)
    append_bodies(scenario.obstacles[i], static_cast<std::uint32_t>(i), view.frame.t, view.bodies);
  if (!publisher_.has_rows() && !scenario.robots)
    view.frame.radius = swarm_limits(scenario.swarm).radius;
  return view;
}

void SessionThread::welcome(std::uint64_t page) {
  publisher_.welcome(page, hello_message(*session_, to_source(opening_)), *session_, shown(),
                     present_view());
}

void SessionThread::obey(std::uint64_t, const Request& request, Issues& issues) {
  Standing& standing = publisher_.standing;
  switch (request.ask) {
    case Ask::play:
      play(request.number);
      break;
    case Ask::pause:
      standing.plays = false;
      publisher_.tell_all(*session_);  // before the answer, so that the sender has the standing
      break;
    case Ask::step:
      standing.plays = false;
      look_at_newest();
      advance();
      break;
    case Ask::speed:
      if (request.number < 0 || request.number > max_speed)
        issues.add("number", "the speed is 0 to 1e6 simulated seconds a second");
      else
        standing.speed = request.number;
      due_ = Clock::now();
      break;
    case Ask::seek:
      look_back(request.number, issues);
      break;
    case Ask::live:
      look_at_newest();
      if (standing.growing && session_->seek(publisher_.rows())) publisher_.freshen();
      break;
    case Ask::set:
      look_at_newest();
      publisher_.set(*session_, request, issues);
      break;
    case Ask::restart:
      restart(request);
      break;
    case Ask::clearance:
      break;  // answered by a message
    case Ask::beat:
    case Ask::ping:
    case Ask::stop:
    case Ask::control:
    case Ask::arm:
    case Ask::dry:
      issues.add({}, "this is no rig");
      break;
    case Ask::hold:
    case Ask::manual:
    case Ask::steer:
    case Ask::end:
      operate(request, issues);
      break;
  }
}

/// Plays; a record at its end starts again.
void SessionThread::play(double until) {
  Standing& standing = publisher_.standing;
  look_at_newest();
  if (session_->is_playback() && standing.ended) {
    session_->seek(0);
    standing.ended = false;
  }
  until_ = until;
  standing.plays = !standing.ended && !is_there();
  due_ = Clock::now();
}

/// Whether the time until which it plays is reached.
bool SessionThread::is_there() {
  if (until_ <= 0) return false;
  const experiment::SessionView view = session_->view();
  return view.frame.t >= until_ - 0.5 * session_->scenario().tick;
}

void SessionThread::restart(const Request& request) {
  const Opening before = opening_;
  opening_.options.settings = Settings(request.settings, "");
  try {
    open();
  } catch (...) {
    opening_.options.settings = before.options.settings;
    throw;
  }
  welcome(0);
}

void SessionThread::advance() {
  Standing& standing = publisher_.standing;
  const Stop stop(&ends_);
  const auto began = Clock::now();
  do {
    const experiment::Tick* tick = session_->step(stop);
    if (tick && session_->is_playback()) publisher_.freshen();
    if (tick && !session_->is_playback()) {
      publisher_.take(*tick);
      keep(*tick, *session_);
    }
    standing.ended = !tick || tick->end;
    if (is_there()) standing.plays = false;
    if (standing.speed > 0) due_ += wall_time(session_->scenario().tick / standing.speed);
  } while (standing.plays && !standing.ended && !ends_ && standing.speed <= 0 &&
           Clock::now() < began + Publisher::frame_period / 2);
  due_ = std::max(due_, Clock::now() - longest_lag);
  if (!standing.ended) return;
  standing.plays = false;
  publisher_.changed();
}

}  // namespace microswarm::lab
