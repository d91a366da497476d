// SPDX-License-Identifier: Apache-2.0
#include <chrono>
#include <optional>
#include <stdexcept>
#include <thread>

#include "bench/lab_client.hpp"
#include "bench/rig.hpp"
#include "bench/running_lab.hpp"
#include "bench/temporary_folder.hpp"
#include "microswarm/experiment/record/record.hpp"

namespace microswarm::bench {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;
using Json = nlohmann::json;

/// The record of the only run in a folder, once it is complete.
fs::path complete_record(const fs::path& runs) {
  const auto limit = Clock::now() + std::chrono::seconds(10);
  while (Clock::now() < limit) {
    for (const auto& run : fs::directory_iterator(runs))
      if (fs::exists(run.path() / "run.h5")) return run.path() / "run.h5";
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  throw std::runtime_error("bench: the lab has not recorded its run");
}

}  // namespace

experiment::RigLatency latency_in_lab(const RigRun& run, int seconds) {
  const TemporaryFolder folder;
  lab::Opening opening{.file = run.scenario,
                       .options = {.settings = {run.settings, ""},
                                   .rig = run.rig,
                                   .rig_settings = {run.rig_settings, ""}},
                       .live = lab::RigOpening{}};
  opening.live->out = folder.path();
  const RunningLab lab({.opening = opening});
  LabClient page(lab.url(), open_lab_session(lab.url(), Json::object()));
  std::string state;
  /// Reads until the rig is in a state, as a page that says that it is there.
  const auto watch = [&](std::string_view until, double limit) {
    const auto began = Clock::now();
    while (state != until && std::chrono::duration<double>(Clock::now() - began).count() < limit) {
      if (const std::string message = page.next(); LabClient::is(message, "rig"))
        state = Json::from_cbor(message).value("state", state);
      page.ask({{"do", "beat"}});
    }
  };
  watch("dry", 10);
  page.ask({{"do", "beat"}});
  page.ask({{"do", "arm"}});
  watch("armed", 20);
  watch("ended", seconds);
  page.ask({{"do", "stop"}});
  watch("ended", 10);
  if (const auto latency = experiment::read_record(complete_record(folder.path())).rig_log.latency)
    return *latency;
  throw std::runtime_error("bench: the lab drove nothing");
}

}  // namespace microswarm::bench
