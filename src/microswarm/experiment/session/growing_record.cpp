// SPDX-License-Identifier: Apache-2.0
#include "microswarm/experiment/session/growing_record.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <iterator>
#include <system_error>

#include "microswarm/core/errors/write_error.hpp"
#include "microswarm/core/execution/priority.hpp"

namespace microswarm::experiment {
namespace {

constexpr double copies_share = 0.02;  ///< share of the session's time
constexpr double first_cost = 2e-7;  ///< assumed time of copying a frame [s], before it is measured
constexpr int writes_share = 10;     ///< inverse share of a core
constexpr std::string_view part_mark = ".part";

double seconds(std::chrono::steady_clock::duration time) {
  return std::chrono::duration<double>(time).count();
}

/// Calls `act` with each pair of tables that only grow during a run.
template <class A, class B, class Act>
void for_growing(A& a, B& b, const Act& act) {
  // A member of either that is not named here does not compile.
  auto& [version, scene, trial, rig, navigator, result, frames, paths, plans, events, changes,
         robots, phased_goals, diagnostics, rig_log, stated_hash] = a;
  auto& [radar, aggregation, predictive, hierarchical] = diagnostics;
  act(frames, b.frames);
  act(paths, b.paths);
  act(plans, b.plans);
  act(events, b.events);
  act(changes, b.changes);
  act(phased_goals, b.phased_goals);
  act(radar, b.diagnostics.radar);
  act(aggregation, b.diagnostics.aggregation);
  act(predictive, b.diagnostics.predictive);
  act(hierarchical, b.diagnostics.hierarchical);
}

/// The least time if there is no such file.
std::filesystem::file_time_type last_written(const std::filesystem::path& file) {
  std::error_code none;
  return std::filesystem::last_write_time(file, none);
}

}  // namespace

std::filesystem::path part_file(const std::filesystem::path& record) {
  std::filesystem::path part = record;
  return part.replace_filename(record.stem().string() + std::string(part_mark) +
                               record.extension().string());
}

std::filesystem::path whole_file(const std::filesystem::path& part) {
  std::string stem = part.stem().string();
  if (!stem.ends_with(part_mark) || stem.size() == part_mark.size()) return {};
  stem.resize(stem.size() - part_mark.size());
  std::filesystem::path whole = part;
  return whole.replace_filename(stem + part.extension().string());
}

void write_whole_record(const Record& record, const std::filesystem::path& file) {
  try {
    write_record(record, file);
  } catch (const InputError& error) {
    std::error_code none;
    if (!std::filesystem::exists(part_file(file), none)) throw;
    throw WriteError(
        fmt::format("{}; the record so far is kept as {}", error.what(), part_file(file).string()));
  }
}

GrowingRecord::GrowingRecord(Session& session, const std::filesystem::path& record,
                             std::chrono::milliseconds period)
    : session_(session),
      file_(record),
      part_(part_file(record)),
      written_(last_written(record)),
      period_(period),
      frame_cost_(first_cost),
      whole_(session.record()),
      thread_([this] { write_all(); }) {
  for_growing(session_.record(), session_.record(),
              [this](const auto& table, const auto&) { taken_.push_back(table.size()); });
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
  if (last_written(file_) != written_) std::filesystem::remove(part_, ignored);
}

void GrowingRecord::on_tick(const Tick& tick) {
  ++new_frames_;
  const auto began = Clock::now();
  if (began < due_ || tick.end) return;
  const double expected = copied_ + new_frames_ * frame_cost_;
  if (expected > copies_share * seconds(began - begun_)) {
    // An interrupted copy took long for its few frames; the estimate recovers gradually.
    frame_cost_ = std::max(first_cost, 0.5 * frame_cost_);
    due_ = began + 5 * period_;
    return;
  }
  if (!can_write()) return;
  auto news = take_news();
  const double took = seconds(Clock::now() - began);
  copied_ += took;
  frame_cost_ = took / new_frames_;
  new_frames_ = 0;
  due_ = began + period_;
  const std::lock_guard lock(mutex_);
  news_ = std::move(news);
  wake_.notify_all();
}

bool GrowingRecord::can_write() {
  const std::lock_guard lock(mutex_);
  return !writes_ && !news_ && Clock::now() >= rests_until_;
}

/// Additions to the record since the last time, and the parts that change as a whole.
std::unique_ptr<Record> GrowingRecord::take_news() {
  const Record& record = session_.record();
  auto news = std::make_unique<Record>();
  std::size_t table = 0;
  for_growing(*news, record, [&](auto& to, const auto& from) {
    to.assign(from.begin() + static_cast<std::ptrdiff_t>(taken_[table]), from.end());
    taken_[table++] = from.size();
  });
  news->result = record.result;
  news->robots = record.robots;
  return news;
}

void GrowingRecord::write_all() {
  lower_priority();
  std::unique_lock lock(mutex_);
  for (;;) {
    wake_.wait(lock, [this] { return ends_ || news_; });
    if (ends_) return;
    const std::unique_ptr<Record> news = std::move(news_);
    writes_ = true;
    lock.unlock();
    const auto began = Clock::now();
    for_growing(whole_, *news, [](auto& to, auto& from) {
      to.insert(to.end(), std::make_move_iterator(from.begin()),
                std::make_move_iterator(from.end()));
    });
    whole_.result = std::move(news->result);
    whole_.robots = std::move(news->robots);
    try {
      write_record(whole_, part_);
    } catch (const std::exception&) {
      // Writing the run's record will report the error of the folder.
    }
    const auto ended = Clock::now();
    lock.lock();
    writes_ = false;
    rests_until_ = ended + writes_share * (ended - began);
  }
}

}  // namespace microswarm::experiment
