// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <condition_variable>
#include <filesystem>
#include <memory>
#include <mutex>
#include <thread>

#include "microswarm/experiment/run/run.hpp"
#include "microswarm/session/session.hpp"

namespace microswarm {

/// The file that holds the record so far of a run that will write `record`: run.part.h5 for run.h5.
std::filesystem::path part_of(const std::filesystem::path& record);
/// The record of which a file is the part: run.h5 for run.part.h5; empty for any other file.
std::filesystem::path whole_of(const std::filesystem::path& part);

/// Keeps the record so far of a session in the part file of its record, for those who watch the run
/// from another program. The file is replaced every few seconds, always whole, and removed with
/// this object. The session's thread only copies the record, for at most 0.5 % of its time; another
/// thread writes. Left out is a run of too many frames a second for that, and what cannot be
/// written: a run never fails for it.
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
  void write_all();

  const Session& session_;
  std::filesystem::path part_;
  std::chrono::milliseconds period_;

  // Of the session's thread.
  Clock::time_point begun_ = Clock::now();
  Clock::time_point due_ = begun_ + period_;  ///< of the next copy
  double more_frames_ = 0;                    ///< since the last copy
  double last_copied_ = 0;                    ///< time that it took [s]
  double all_copied_ = 0;                     ///< time of all copies [s]

  std::mutex mutex_;
  std::condition_variable wake_;
  std::unique_ptr<Record> copy_;  ///< to be written; guarded, as are the next two
  bool writes_ = false;
  bool ends_ = false;
  Clock::time_point rests_until_{};  ///< so that writing takes a small share of a core; guarded
  std::thread thread_;
};

}  // namespace microswarm
