// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <mutex>
#include <string>
#include <string_view>

#include "microswarm/core/execution/descriptor.hpp"

namespace microswarm::cli {

/// Reports to the manager of services that started the program, such as systemd, by the
/// datagrams of sd_notify(3) to $NOTIFY_SOCKET; silent without one. Every function may be called
/// from any thread; a manager that cannot be reached is ignored.
class ServiceManager {
 public:
  ServiceManager();
  ~ServiceManager() = default;
  ServiceManager(const ServiceManager&) = delete;
  ServiceManager& operator=(const ServiceManager&) = delete;

  /// Says once that the program has started; only from then on it needs signs of life.
  void ready();
  /// Says in one line what it does.
  void status(std::string_view what);
  /// Says that it is ending, and needs no more signs of life.
  void stopping(std::string_view why);

  /// Sign of life of the main loop; none while the coils are driven.
  void live();
  /// Sign of life of the loop that drives the coils, the first time with a status.
  void drive();
  /// Says that the coils are no longer driven; `why` may be empty.
  void rest(std::string_view why);

 private:
  void send(const std::string& message);
  void give_sign();

  std::mutex mutex_;
  Descriptor socket_;
  double period_ = 0;  // of signs of life [s], half of $WATCHDOG_USEC; 0: none are asked for
  double last_ = 0;    // sign of life [s], by steady_seconds()
  bool is_ready_ = false;
  bool drives_ = false;
};

}  // namespace microswarm::cli
