// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "lab/sessions/host.hpp"
#include "lab/sessions/record_watch.hpp"

namespace microswarm::lab {

/// A session in simulated time: steps at its speed, shows earlier frames, restarts. Follows a
/// record that a run still writes.
class SessionThread : public Host {
 public:
  /// Opens the file of a session; on a simulated rig if the options name one.
  using Open = std::function<std::unique_ptr<experiment::Session>(
      const std::filesystem::path& file, const rig::RigSessionOptions& options)>;

  SessionThread(Opening opening, Callbacks callbacks, Open open)
      : Host(std::move(opening), std::move(callbacks)),
        open_(std::move(open)),
        watch_(opening_.file) {
    begin();
  }
  ~SessionThread() override { finish(); }
  SessionThread(const SessionThread&) = delete;
  SessionThread& operator=(const SessionThread&) = delete;

  void rest() override;

 private:
  void open() override;
  void open_branch(const Branch& branch);
  void serve() override;
  experiment::Session& session() override { return *session_; }
  void welcome(std::uint64_t page) override;
  void obey(std::uint64_t page, const Request& request, Issues& issues) override;

  std::optional<Clock::time_point> next_act(bool is_due) const;
  void play(double until);
  bool is_there();
  void restart(const Request& request);
  experiment::SessionView present_view();
  void advance();
  void look_for_more();
  void grow();

  Open open_;
  std::unique_ptr<experiment::Session> session_;
  Clock::time_point due_{};  ///< time of the next tick
  double until_ = 0;         ///< time at which it pauses [s]; 0 for the end
  RecordWatch watch_;
  Clock::time_point looks_{};  ///< period of checks for more of a growing record
};

}  // namespace microswarm::lab
