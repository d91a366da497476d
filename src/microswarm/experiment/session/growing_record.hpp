// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <condition_variable>
#include <filesystem>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

#include "microswarm/core/execution/inheriting_mutex.hpp"
#include "microswarm/experiment/session/session.hpp"

namespace microswarm::experiment {

/// File with the record so far of a run that will write `record`: run.part.h5 for run.h5.
std::filesystem::path part_file(const std::filesystem::path& record);
/// Record of a part file: run.h5 for run.part.h5; empty for another file.
std::filesystem::path whole_file(const std::filesystem::path& part);

/// Writes the whole record of a run. Throws InputError, which names the part file if that remains.
void write_whole_record(const Record& record, const std::filesystem::path& file);

/// Writes the record so far of a session into the part file of its record, so that other programs
/// can follow the run. The file is replaced atomically every few seconds. The destructor removes it
/// if the whole record was written meanwhile; otherwise, or if the program is killed, it remains.
/// The session's thread only copies additions, for
/// at most 2 % of its time; another thread writes. A run with too many frames a second for that is
/// not written. A failure to write never affects the run.
class GrowingRecord : public RunListener {
 public:
  /// Listens to a session, which must outlive it.
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
  std::filesystem::path file_;
  std::filesystem::path part_;
  std::filesystem::file_time_type written_;  ///< of a record of an earlier run
  std::chrono::milliseconds period_;

  // State of the session's thread.
  Clock::time_point begun_ = Clock::now();
  Clock::time_point due_ = begun_ + period_;  ///< time of the next copy
  std::vector<std::size_t> taken_;            ///< rows copied of each growing table
  double new_frames_ = 0;                     ///< frames since the last copy
  double frame_cost_;                         ///< time to copy a frame [s]
  double copied_ = 0;                         ///< total time of all copies [s]

  Record whole_;  ///< owned by the writing thread

  InheritingMutex mutex_;
  std::condition_variable_any wake_;
  std::unique_ptr<Record> news_;  ///< to be written; guarded, as the next two
  bool writes_ = false;
  bool ends_ = false;
  Clock::time_point rests_until_{};  ///< limits the share of a core for writing; guarded
  std::thread thread_;
};

}  // namespace microswarm::experiment
