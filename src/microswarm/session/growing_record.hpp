// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <condition_variable>
#include <filesystem>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

#include "microswarm/experiment/run/run.hpp"
#include "microswarm/session/session.hpp"

namespace microswarm {

/// The file that holds the record so far of a run that will write `record`: run.part.h5 for run.h5.
std::filesystem::path part_of(const std::filesystem::path& record);
/// The record of which a file is the part: run.h5 for run.part.h5; empty for any other file.
std::filesystem::path whole_of(const std::filesystem::path& part);

/// Keeps the record so far of a session in the part file of its record, for those who watch the run
/// from another program. The file is replaced every few seconds, always whole, and removed with
/// this object; it stays if the program is killed. The session's thread only copies what is new,
/// for at most 2 % of its time; another thread writes. Left out is a run of too many frames a
/// second for that, and what cannot be written: a run never fails for it.
class GrowingRecord : public RunListener {
 public:
  /// Of a session that it listens to from now on, and that must outlive it.
  GrowingRecord(Session& session, const std::filesystem::path& record,
                std::chrono::milliseconds period = std::chrono::seconds(2));
  ~GrowingRecord() override;
  GrowingRecord(const GrowingRecord&) = delete;
  GrowingRecord& operator=(const GrowingRecord&) = delete;

  void on_tick(const Tick& tick) override;

 private:
  using Clock = std::chrono::steady_clock;
  bool can_write();
  std::unique_ptr<Record> take_news();
  void write_all();

  const Session& session_;
  std::filesystem::path part_;
  std::chrono::milliseconds period_;

  // Of the session's thread.
  Clock::time_point begun_ = Clock::now();
  Clock::time_point due_ = begun_ + period_;  ///< of the next copy
  std::vector<std::size_t> taken_;            ///< of each table that grows
  double new_frames_ = 0;                     ///< since the last copy
  double frame_cost_;                         ///< time to copy one [s]
  double copied_ = 0;                         ///< time of all copies [s]

  Record whole_;  ///< of the writing thread

  std::mutex mutex_;
  std::condition_variable wake_;
  std::unique_ptr<Record> news_;  ///< to be written; guarded, as are the next two
  bool writes_ = false;
  bool ends_ = false;
  Clock::time_point rests_until_{};  ///< so that writing takes a small share of a core; guarded
  std::thread thread_;
};

}  // namespace microswarm
