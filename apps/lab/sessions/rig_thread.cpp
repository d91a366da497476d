// SPDX-License-Identifier: Apache-2.0
#include "lab/sessions/rig_thread.hpp"

#include <fmt/chrono.h>
#include <fmt/ranges.h>

#include <chrono>
#include <ctime>
#include <utility>
#include <vector>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/rig/runtime/rig_checks.hpp"
#include "microswarm/rig/runtime/rig_priority.hpp"
#include "microswarm/vision/image/threads.hpp"

namespace microswarm::lab {
namespace {

using namespace std::chrono_literals;

constexpr auto rig_period = 100ms;
constexpr const char* record_name = "run.h5";
constexpr const char* stopped_by_page = "a page stopped it";

/// Relaxes limits for a dry run, so that it continues while light and focus are adjusted.
void be_patient(rig::SafetyParams& safety) {
  constexpr double long_time = 100;  // [s]
  safety.lost_swarm = safety.max_frame_age = safety.max_pause = long_time;
  safety.deadman = long_time;
  safety.missed_deadlines = 1'000'000;
  safety.max_light_change = safety.min_focus = safety.max_unseen_share = 0;  // not checked
}

}  // namespace

RigThread::RigThread(Opening opening, Callbacks callbacks)
    : Host(std::move(opening), std::move(callbacks)), pictures_(callbacks_.send) {
  vision::set_picture_threads(1);
  begin();
}

RigThread::~RigThread() { finish(); }

void RigThread::end() {
  Host::end();  // first: what is stopped by this has no fault
  halted_ = true;
  guard_.stop("the session was closed");
}

void RigThread::stop(const std::string& why) { guard_.stop(why); }

void RigThread::join(std::uint64_t page) {
  {
    const std::lock_guard lock(seats_mutex_);
    seats_.insert(page);
    if (holder_ == 0) holder_ = page;
  }
  Host::join(page);
}

void RigThread::leave(std::uint64_t page) {
  {
    const std::lock_guard lock(seats_mutex_);
    seats_.erase(page);
    if (holder_ == page) {
      holder_ = 0;
      if (drives_) guard_.stop("the page with the controls is gone");
    }
  }
  later([this, page] {
    welcomed_.erase(page);
    tell_controls();
  });
}

bool RigThread::has_controls(std::uint64_t page) const {
  const std::lock_guard lock(seats_mutex_);
  return holder_ == page;
}

void RigThread::ask(std::uint64_t page, Request request) {
  if (request.ask == Ask::beat) {
    if (has_controls(page)) guard_.beat();
    return;
  }
  if (request.ask == Ask::stop) {
    halted_ = true;
    guard_.stop(stopped_by_page, rig::FaultKind::none);
  }
  if (request.ask == Ask::control) {
    const std::lock_guard lock(seats_mutex_);
    if (holder_ == 0) holder_ = page;
  }
  if (request.ask == Ask::arm)
    later([this, page, request = std::move(request), stops = guard_.stops()] {
      arm(page, request, stops);
    });
  else
    Host::ask(page, std::move(request));
}

/// The current run, or the record of the previous one.
experiment::Session& RigThread::session() {
  if (live_) return live_->session();
  if (!last_) throw InputError("the rig is not open");
  return *last_;
}

void RigThread::open() { begin_run(true, guard_.stops()); }

/// Releases the devices before the session is destroyed.
void RigThread::close() {
  guard_.stop("the session was closed");
  if (runs()) end_run();
  guard_.release();
  live_.reset();
  fault_command_.finish();  // not in the destructor, which runs in the thread of the pages
}

/// Reopens the rig.
void RigThread::begin_run(bool dry, std::uint64_t stops) {
  const rig::RigSessionOptions& o = opening_.options;
  if (opening_.check) opening_.check(o.settings);
  rig::RigExperiment on =
      rig::open_rig_experiment(opening_.file, o.settings, o.rig, o.rig_settings);
  if (dry) be_patient(on.rig.params.safety);
  if (!dry && rig::has_coil_device(on.rig) && rig::shows_drawn_swarm(on.rig.params) &&
      !opening_.live->drawn_swarm)
    throw InputError(
        "the camera is simulated and the coil driver is not: real coils would be driven for a "
        "drawn swarm; for a test, start the lab with --drawn-swarm");
  const rig::LiveOptions options{.dry = dry,
                                 .idle = dry,
                                 .folder = dry ? std::filesystem::path() : new_folder(),
                                 .without_limits = opening_.live->without_limits,
                                 .coils_cold = *opening_.live->coils_cold,
                                 .driven = dry ? nullptr : opening_.live->driven};
  keep_last();
  standing_ = {.state = RigState::opening, .folder = options.folder.string()};
  tell_rig();
  drives_ = !dry;
  halted_ = false;
  live_ = std::make_shared<rig::LiveSession>(on, options);
  if (!dry) *opening_.live->coils_cold = false;  // said once, of the coils as they were then
  guard_.watch(live_, !dry, stops, rig::urgent_priority(on.rig));
  if (!options.folder.empty())
    growing_ =
        std::make_unique<experiment::GrowingRecord>(live_->session(), options.folder / record_name);
  warnings_ = live_->warnings();
  if (const std::string unusual = rig::unusual_field(on.rig, on.scenario()); !unusual.empty())
    warnings_.push_back(unusual);
  standing_.state = dry ? RigState::dry : RigState::armed;
  publisher_.clear();
  publisher_.standing.speed = 1;
  publisher_.standing.plays = true;
  pictures_.offer(live_->live().picture(), live_->live().scale(), 0);
}

/// Closes the devices, and keeps the record.
void RigThread::keep_last() {
  look_at_newest();
  if (!live_) return;
  if (runs()) end_run();
  guard_.release();
  last_ = std::make_unique<experiment::Session>(experiment::Record(live_->session().record()));
  live_.reset();
}

/// A new folder named by date and time.
std::filesystem::path RigThread::new_folder() const {
  if (opening_.live->out.empty()) return {};
  const auto now = fmt::format("{:%Y-%m-%d_%H%M%S}", fmt::localtime(std::time(nullptr)));
  std::filesystem::path folder = opening_.live->out / now;
  for (int i = 2; std::filesystem::exists(folder); ++i)
    folder = opening_.live->out / fmt::format("{}_{}", now, i);
  std::filesystem::create_directories(folder);
  return folder;
}

void RigThread::serve() {
  if (runs())
    work_until(Clock::time_point{});
  else if (publisher_.is_fresh())
    work_until(publisher_.next_frame());
  else
    work_until(std::nullopt);
  if (ends_) return;
  if (runs()) step();
  publisher_.publish(session(), shown(), [this] { return shown().view(); });
  newest_ = publisher_.newest();
  if (Clock::now() >= told_ + rig_period) tell_rig();
}

void RigThread::step() {
  const experiment::Tick* tick = live_->session().step(Stop(&halted_));
  if (tick) publisher_.take(*tick);
  if (const std::vector<std::string> notes = live_->take_notes(); !notes.empty()) {
    publisher_.standing.trouble = fmt::format("{}", fmt::join(notes, "; "));
    publisher_.changed();
  }
  if (tick && !tick->fault.empty()) standing_.why = tick->fault;
  pictures_.offer(live_->live().picture(), live_->live().scale(), tick ? tick->frame.t : 0);
  if (!tick || tick->end) {
    end_run();
    tell_rig();
  }
}

/// Sets the coils to zero and keeps the record; `failure` is an exception's reason.
void RigThread::end_run(const std::string& failure) {
  Standing& standing = publisher_.standing;
  const bool drove = standing_.state == RigState::armed;
  standing.plays = false;
  standing.ended = true;
  standing_.state = RigState::ended;
  std::string lost = live_->close();
  drives_ = false;
  if (standing_.why.empty())
    standing_.why =
        halted_ && !ends_ ? stopped_by_page : to_string(live_->session().result().status);
  if (drove) {
    standing_.zero = live_->stop("the run has ended");
    const bool is_closed = ends_ && failure.empty() && standing_.zero->good();
    const std::string fault = is_closed || !failure.empty() ? failure : live_->fault();
    if (!fault.empty()) fault_command_.start(live_->rig(), fault, standing_.folder);
    opening_.live->ended(fault);
  }
  try {
    if (!standing_.folder.empty())
      experiment::write_whole_record(live_->session().record(),
                                     std::filesystem::path(standing_.folder) / record_name);
  } catch (const InputError& error) {
    lost += (lost.empty() ? "" : "; ") + std::string(error.what());
  }
  growing_.reset();
  if (!lost.empty()) standing.trouble = lost;
  publisher_.changed();
}

void RigThread::fail(const std::string& why) {
  guard_.stop(why);
  if (runs()) end_run(why);
  publisher_.standing.trouble = why;
  if (live_ || last_) publisher_.tell_standing(session());
  tell_rig();
}

void RigThread::welcome(std::uint64_t page) {
  const MessagePtr hello =
      live_ ? rig_hello_message(live_->session(), to_source(opening_), live_->rig(), warnings_)
            : hello_message(session(), to_source(opening_));
  publisher_.welcome(page, hello, session(), shown(), shown().view());
  if (page != 0) {
    welcomed_.insert(page);
    pictures_.welcome(page);
  }
  tell_rig();
  tell_controls();
}

void RigThread::tell_rig() {
  told_ = Clock::now();
  callbacks_.send(0, rig_message(standing_, live_.get()));
}

void RigThread::tell_controls() {
  std::uint64_t holder = 0;
  {
    const std::lock_guard lock(seats_mutex_);
    holder = holder_;
  }
  for (const std::uint64_t page : welcomed_)
    callbacks_.send(page, controls_message(page == holder, holder == 0, welcomed_.size()));
}

void RigThread::arm(std::uint64_t page, const Request& request, std::uint64_t stops) {
  Issues issues;
  const auto end_opening = [&](const auto& error) {
    issues.add(to_issues(error));
    drives_ = false;
    if (standing_.state == RigState::opening) standing_.state = RigState::ended;
    if (standing_.why.empty()) standing_.why = error.what();
    tell_rig();
  };
  try {
    if (!has_controls(page)) {
      issues.add({}, "another page has the controls");
    } else if (!guard_.hears()) {
      issues.add({}, "the page was silent: the coils would be stopped at once");
    } else if (guard_.stops() != stops) {
      issues.add({}, "it was stopped meanwhile");
    } else {
      begin_run(false, stops);
      welcome(0);
    }
  } catch (const InputError& error) {
    end_opening(error);
  } catch (const std::exception& error) {
    end_opening(error);
  }
  publisher_.changed();
  callbacks_.send(page, answer_message(request.id, issues));
}

void RigThread::obey(std::uint64_t page, const Request& request, Issues& issues) {
  const bool is_for_all =
      request.ask == Ask::stop || request.ask == Ask::clearance || request.ask == Ask::control;
  if (!is_for_all && !has_controls(page)) {
    issues.add({}, "another page has the controls");
    return;
  }
  switch (request.ask) {
    case Ask::set:
      publisher_.set(session(), request, issues);
      break;
    case Ask::hold:
    case Ask::manual:
    case Ask::steer:
    case Ask::end:
      operate(request, issues);
      break;
    case Ask::restart: {
      auto before = std::exchange(opening_.options.settings, Settings(request.settings, ""));
      try {
        begin_run(true, guard_.stops());
      } catch (...) {
        opening_.options.settings = std::move(before);
        throw;
      }
      welcome(0);
      break;
    }
    case Ask::dry:
      begin_run(true, guard_.stops());
      welcome(0);
      break;
    case Ask::seek:
      if (runs())
        issues.add({}, "a rig that runs shows the present");
      else
        look_back(request.number, issues);
      break;
    case Ask::live:
      look_at_newest();
      break;
    case Ask::control:
      if (!has_controls(page)) issues.add({}, "another page has the controls");
      tell_controls();
      break;
    case Ask::play:
    case Ask::pause:
    case Ask::step:
    case Ask::speed:
      issues.add({}, "a rig runs in real time");
      break;
    case Ask::stop:
    case Ask::arm:
    case Ask::beat:
    case Ask::ping:
    case Ask::clearance:
      break;  // handled by the caller, or answered by a message
  }
}

}  // namespace microswarm::lab
