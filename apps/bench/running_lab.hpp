// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <string>
#include <thread>
#include <utility>

#include "lab/net/server.hpp"

namespace microswarm::bench {

/// A lab in this process, which serves until the object's end.
class RunningLab {
 public:
  explicit RunningLab(lab::ServerOptions options) : server_(std::move(options)) {
    thread_ = std::thread([this] { server_.run(Stop(&stop_)); });
  }
  ~RunningLab() {
    stop_ = true;
    thread_.join();
  }
  RunningLab(const RunningLab&) = delete;
  RunningLab& operator=(const RunningLab&) = delete;
  std::string url() const { return server_.url(); }

 private:
  lab::Server server_;
  std::atomic<bool> stop_ = false;
  std::thread thread_;
};

}  // namespace microswarm::bench
