// SPDX-License-Identifier: Apache-2.0
#include "microswarm/session/growing_record.hpp"

#include <sched.h>
#include <sys/resource.h>

#include <algorithm>
#include <exception>
#include <system_error>

namespace microswarm {
namespace {

constexpr double copies_share = 0.005;  ///< of the session's time
constexpr double frame_cost = 1e-6;     ///< of a copy, about, of a frame alone [s]
constexpr int writes_share = 20;        ///< of a core's, one part
constexpr std::string_view part_mark = ".part";

double seconds(std::chrono::steady_clock::duration time) {
  return std::chrono::duration<double>(time).count();
}

/// This thread gives way to all others, also where the session's has real-time priority.
void yield_to_others() {
  const sched_param none{};
  ::sched_setscheduler(0, SCHED_OTHER, &none);
  ::setpriority(PRIO_PROCESS, 0, 10);
}

}  // namespace

std::filesystem::path part_of(const std::filesystem::path& record) {
  std::filesystem::path part = record;
  return part.replace_filename(record.stem().string() + std::string(part_mark) +
                               record.extension().string());
}

std::filesystem::path whole_of(const std::filesystem::path& part) {
  std::string stem = part.stem().string();
  if (!stem.ends_with(part_mark) || stem.size() == part_mark.size()) return {};
  stem.resize(stem.size() - part_mark.size());
  std::filesystem::path whole = part;
  return whole.replace_filename(stem + part.extension().string());
}

GrowingRecord::GrowingRecord(Session& session, const std::filesystem::path& record,
                             std::chrono::milliseconds period)
    : session_(session),
      part_(part_of(record)),
      period_(period),
      due_(Clock::now() + period),
      thread_([this] { write_all(); }) {
  session.listen(*this);
}

GrowingRecord::~GrowingRecord() {
  {
    const std::lock_guard lock(mutex_);
    ends_ = true;
    wake_.notify_all();
  }
  thread_.join();
  std::error_code ignored;
  std::filesystem::remove(part_, ignored);
}

void GrowingRecord::on_tick(const Tick& tick) {
  const auto began = Clock::now();
  ++more_frames_;
  if (began < due_ || tick.end) return;
  const double expected = last_copied_ + more_frames_ * frame_cost;
  if (all_copied_ + expected > copies_share * seconds(began - begun_)) return;
  {
    const std::lock_guard lock(mutex_);
    if (writes_ || copy_ || began < rests_until_) return;
  }
  auto copy = std::make_unique<Record>(session_.record());
  last_copied_ = seconds(Clock::now() - began);
  all_copied_ += last_copied_;
  more_frames_ = 0;
  due_ = began + period_;
  const std::lock_guard lock(mutex_);
  copy_ = std::move(copy);
  wake_.notify_all();
}

void GrowingRecord::write_all() {
  yield_to_others();
  std::unique_lock lock(mutex_);
  for (;;) {
    wake_.wait(lock, [this] { return ends_ || copy_; });
    if (ends_) return;
    const std::unique_ptr<Record> record = std::move(copy_);
    writes_ = true;
    lock.unlock();
    const auto began = Clock::now();
    try {
      write_record(*record, part_);
    } catch (const std::exception&) {
      // The run's own record says what is wrong with the folder.
    }
    const auto ended = Clock::now();
    lock.lock();
    writes_ = false;
    rests_until_ = ended + writes_share * (ended - began);
  }
}

}  // namespace microswarm
