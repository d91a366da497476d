// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <memory>
#include <mutex>
#include <set>

#include "lab/sessions/host.hpp"
#include "lab/sessions/rig_guard.hpp"
#include "lab/stream/picture_sender.hpp"
#include "lab/stream/rig_stream.hpp"
#include "microswarm/experiment/session/growing_record.hpp"
#include "microswarm/rig/session/fault_command.hpp"

namespace microswarm::lab {

/// A session on a rig in real time. It starts as a dry run without currents; arming reopens the rig
/// and drives the coils. One page has the controls; the others watch and may stop the rig.
class RigThread : public Host {
 public:
  RigThread(Opening opening, Callbacks callbacks);
  ~RigThread() override;
  RigThread(const RigThread&) = delete;
  RigThread& operator=(const RigThread&) = delete;

  void end() override;
  void join(std::uint64_t page) override;
  void leave(std::uint64_t page) override;
  void ask(std::uint64_t page, Request request) override;
  bool drives() const override { return drives_; }
  void stop(const std::string& why) override;

 private:
  void open() override;
  void close() override;
  void serve() override;
  experiment::Session& session() override;
  void welcome(std::uint64_t page) override;
  void obey(std::uint64_t page, const Request& request, Issues& issues) override;
  void fail(const std::string& why) override;

  bool runs() const { return live_ && !publisher_.standing.ended; }
  bool has_controls(std::uint64_t page) const;
  void arm(std::uint64_t page, const Request& request, std::uint64_t stops);
  void begin_run(bool dry, std::uint64_t stops);
  void keep_last();
  void step();
  void end_run(const std::string& failure = {});
  void tell_rig();
  void tell_controls();
  std::filesystem::path new_folder() const;

  mutable std::mutex seats_mutex_;
  std::set<std::uint64_t> seats_;     ///< numbers of the pages; guarded
  std::uint64_t holder_ = 0;          ///< page with the controls; guarded
  std::atomic<bool> drives_ = false;  ///< whether the coils are or will soon be driven
  std::atomic<bool> halted_ = false;  ///< whether a page stopped the run

  // State of the session's thread.
  std::shared_ptr<rig::LiveSession> live_;
  std::unique_ptr<experiment::GrowingRecord> growing_;  ///< of a run with a folder
  std::unique_ptr<experiment::Session> last_;           ///< previous run, while none is open
  RigStanding standing_;
  std::vector<std::string> warnings_;
  std::set<std::uint64_t> welcomed_;  ///< pages that got their hello
  Clock::time_point told_{};          ///< time of the last rig message
  PictureSender pictures_;
  RigGuard guard_;
  rig::FaultCommand fault_command_{
      [this](const std::string& failed) { opening_.live->note(failed); }};
};

}  // namespace microswarm::lab
