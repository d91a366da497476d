// SPDX-License-Identifier: Apache-2.0
// A rig whose fields are measured by an operator or by the logger of a probe.
#pragma once

#include <Eigen/Dense>
#include <atomic>
#include <fstream>
#include <mutex>
#include <nlohmann/json.hpp>
#include <thread>

#include "driven_rig.hpp"
#include "microswarm/actuation/coils/coil_system.hpp"
#include "microswarm/core/text/lines.hpp"
#include "terminal.hpp"

namespace microswarm::test {

using Json = nlohmann::json;

inline constexpr const char* question = "Bx By Bz in mT: ";

class RigMeasure : public DrivenRig {
 protected:
  RigMeasure() : device([this](actuation::CoilReply& reply) { return hear(reply); }) {
    write_coils("max_current_a: 12, max_voltage_v: 24, max_temperature_degc: 90");
    write_rig(device);
    // Within the tolerances beside 2.25, 2.29 and 2.31 mT/A of the coil file.
    truth_A << 1.9, 0.1, -0.02, 0.05, 2.4, 0.3, -0.2, 0, 2.1;
    truth_G << 3, -1, 0.5, 0.2, 2, -0.4, 1, 0, 0.7, -2, 0.1, 0.9, 0.3, -0.6, 4;  // [T/m/A]
    truth_G *= 0.01;
  }

  bool hear(const actuation::CoilReply& reply) {
    const std::lock_guard lock(mutex);
    outputs = reply.outputs;
    if (reply.to == actuation::CoilMessage::stop) outputs = {};
    return true;
  }
  Eigen::Vector3d currents() {
    const std::lock_guard lock(mutex);
    return {outputs[0] / 100.0, outputs[1] / 100.0, outputs[2] / 100.0};
  }
  Eigen::Vector3d truth(const Eigen::Vector3d& position = Eigen::Vector3d::Zero()) {
    const Eigen::Vector3d I = currents();
    const Eigen::Matrix3d G = actuation::gradient_matrix(actuation::FiveGradients(truth_G * I)) *
                              actuation::mt_per_um_of_t_per_m;
    return truth_A * I + G * position + Eigen::Vector3d(0.02, -0.03, 0.045);
  }
  static std::string typed(const Eigen::Vector3d& b) {
    return std::to_string(b[0]) + " " + std::to_string(b[1]) + ", " + std::to_string(b[2]) + "\r";
  }
  Arguments arguments(const Arguments& more = {}) const {
    Arguments all{"rig",          "calibrate",   "measured.csv", "--measure", "rig.yaml",
                  "--coils-cold", "--ramp",      "0.1",          "--settle",  "0.1",
                  "--out",        "fitted.yaml", "--current",    "4"};
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }
  /// The probe is in place.
  static void begin(Terminal& terminal) {
    ASSERT_TRUE(terminal.hears("then Enter")) << terminal.said();
    terminal.press("\r");
  }
  /// No clamp meter is at hand.
  static void skip_clamp(Terminal& terminal) {
    ASSERT_TRUE(terminal.hears("by a clamp meter")) << terminal.said();
    terminal.press("\r");
  }
  /// Answers `count` questions, from the first on.
  void answer_first(Terminal& terminal, int count, const Eigen::Vector3d& position) {
    answer(terminal, 1, position);
    skip_clamp(terminal);
    answer(terminal, count - 1, position);
  }
  /// Answers `count` questions.
  void answer(Terminal& terminal, int count, const Eigen::Vector3d& position) {
    for (int i = 0; i < count; ++i) {
      ASSERT_TRUE(terminal.hears(question)) << terminal.said();
      terminal.press(typed(truth(position)));
    }
  }
  std::size_t rows() const {
    const std::string text = read("measured.csv");
    return static_cast<std::size_t>(std::ranges::count(text, '\n')) - 1;
  }
  void expect_truth(const std::string& file, double within) const {
    const actuation::CoilSystem system = actuation::read_coil_system(at.folder / file);
    const actuation::Actuation there = system.at(Eigen::Vector3d::Zero());
    EXPECT_LE((there.field - truth_A).cwiseAbs().maxCoeff(), within) << there.field;
    EXPECT_NEAR(there.offset.field[2], 0.045, within);
  }

  std::mutex mutex;
  actuation::CoilOutputs outputs{};
  Eigen::Matrix3d truth_A;
  Eigen::Matrix<double, 5, 3> truth_G;
  FakeDevice device;
};

/// A logger that appends a row every 10 ms until it ends.
class Logger {
 public:
  /// `noise` [mT] is added to and taken from the field in turns.
  Logger(const fs::path& file, std::function<Eigen::Vector3d()> field, double noise = 0.01) {
    std::ofstream(file) << "t_s,bx_mt,by_mt,bz_mt,temperature\n";
    thread_ = std::thread([this, file, field = std::move(field), noise] {
      std::ofstream out(file, std::ios::app);
      for (int i = 0; !ended_; ++i) {
        const Eigen::Vector3d b = field();
        out << 0.01 * i << ',' << b[0] + (i % 2 ? noise : -noise) << ',' << b[1];
        out.flush();  // a row in two pieces
        out << ',' << b[2] << ",21\n";
        out.flush();
        sleep_ms(10);
      }
    });
  }
  ~Logger() {
    ended_ = true;
    thread_.join();
  }
  Logger(const Logger&) = delete;
  Logger& operator=(const Logger&) = delete;

 private:
  std::atomic<bool> ended_ = false;
  std::thread thread_;
};

}  // namespace microswarm::test
