// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "microswarm/config/type.hpp"
#include "microswarm/core/fields/fields.hpp"

namespace microswarm::rig {

/// Action after an attempt that ended with a fault.
enum class AfterFault {
  skip,   ///< the entry has failed, the next one follows
  retry,  ///< the entry is tried again, up to `retries` times, then as skip
  stop    ///< the queue stops
};
constexpr auto enum_names(AfterFault) {
  return std::array<std::pair<AfterFault, std::string_view>, 3>{
      {{AfterFault::skip, "skip"}, {AfterFault::retry, "retry"}, {AfterFault::stop, "stop"}}};
}

/// Action when the disk has too little space for an entry.
enum class FullDisk { stop, pause };
constexpr auto enum_names(FullDisk) {
  return std::array<std::pair<FullDisk, std::string_view>, 2>{
      {{FullDisk::stop, "stop"}, {FullDisk::pause, "pause"}}};
}

/// Budgets and rules of an entry; what it does not give is as in the queue.
struct QueueRules {
  std::optional<double> time_budget{};  // [s]
  std::optional<double> start_below{};  // [°C]
  std::optional<AfterFault> on_fault{};
  std::optional<int> retries{};
  std::optional<bool> anywhere{};
  std::optional<bool> video{};
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.time_budget,
          s("time_budget", 0.1, 1e6, "Longest run; none: time limit and hold of the scenario."));
    visit(self.start_below, degc("start_below", -50, 1000,
                                 "Hottest coil at the start; none: half way to its limit."));
    visit(self.on_fault, plain("on_fault", "After a fault that needs no person; none: skip."));
    visit(self.retries, plain("retries", 1, 100, "Further attempts with `retry`; none: 1."));
    visit(self.anywhere, plain("anywhere", "The swarm may be anywhere at the start; none: true."));
    visit(self.video, plain("video", "Record the camera; none: false."));
  }
};

/// A scenario of a queue.
struct QueueEntry {
  std::string scenario{};
  std::string name{};
  int repeat = 1;
  std::vector<std::string> set{};
  QueueRules rules{};
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.scenario, plain("scenario", "Scenario file, beside this one.").needed());
    visit(self.name, plain("name", "Name in folders and tables; none: that of the file."));
    visit(self.repeat, plain("repeat", 1, 10000, "Number of runs."));
    visit(self.set, plain("set", "Settings KEY=VALUE of the scenario."));
    QueueRules::fields(self.rules, visit);
  }
};

/// Contents of a queue file.
struct QueueParams {
  std::string name{};
  std::vector<QueueEntry> entries{};
  std::vector<std::string> set{};
  QueueRules rules{};
  std::optional<double> hours{};
  std::string until{};
  int faults_in_a_row = 3;
  int interruptions = 2;
  FullDisk full_disk = FullDisk::stop;
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.name, plain("name", "Name of the queue."));
    visit(self.entries, plain("entries", "What is run, in this order.").needed());
    visit(self.set, plain("set", "Settings KEY=VALUE of all scenarios."));
    QueueRules::fields(self.rules, visit);
    visit(self.hours, plain("hours", 1e-3, 1e4, "Duration of the queue [h]; none: no limit."));
    visit(self.until, plain("until", "Its end as local time HH:MM; none: no limit."));
    visit(self.faults_in_a_row,
          plain("faults_in_a_row", 1, 1000, "Attempts with a fault after which it stops."));
    visit(self.interruptions,
          plain("interruptions", 0, 1000, "Times an entry is tried again after a power cut."));
    visit(self.full_disk, plain("full_disk", "Without space for an entry: stop, or pause."));
  }
};

}  // namespace microswarm::rig

namespace microswarm {

/// Compiled once, in queue.cpp.
extern template const Type& type_of<rig::QueueParams>();

}  // namespace microswarm
