// SPDX-License-Identifier: Apache-2.0
// docs/tutorials/first-rig.md, walked command by command: a board as it is sold in a simulator, a
// camera of V4L2 that is not there, and between them the physics of a simulated rig, which knows
// only what the board's pins do.
#include <sys/resource.h>

#include <array>
#include <atomic>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <memory>
#include <mutex>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "microswarm/core/execution/clock.hpp"
#include "microswarm/core/text/file.hpp"
#include "microswarm/experiment/record/record.hpp"
#include "microswarm/rig/params/rig_experiment.hpp"
#include "microswarm/rig/simulation/rig_simulator.hpp"
#include "tests/cli/terminal.hpp"
#include "tests/firmware/simulator.hpp"

namespace microswarm::test {
namespace {

constexpr double bench_full_scale = 10;  // [A], bench.yaml
constexpr double um_per_px = 4.2;

enum class Scene { slide, empty, swarm };

/// What the board, the amplifiers, the coils, the swarm and the camera do.
class Bench {
 public:
  Bench(const fs::path& folder, const fs::path& picture)
      : picture_(picture),
        on_(rig::open_rig_experiment(folder / "first_rig.yaml", {}, folder / "bench.yaml",
                                     {"camera.type=simulated", "camera.microscope.um_per_px=4.2",
                                      "camera.microscope.margin_px=0"})),
        physics_(on_.scenario(), World{on_.experiment.world.map, {}}, on_.rig),
        camera_([this] { expose(); }) {}
  ~Bench() {
    over_ = true;
    camera_.join();
  }
  Bench(const Bench&) = delete;
  Bench& operator=(const Bench&) = delete;

  void show(Scene scene) {
    shown_ = scene;
    const int before = exposed_;
    while (exposed_ < before + 2) std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  void take(const Outputs& outputs) {
    const std::lock_guard lock(mutex_);
    catch_up();
    for (std::size_t k = 0; k < currents_.size(); ++k)
      currents_[k] = 1e-3 * outputs[k] * bench_full_scale;
    for (std::size_t k = 0; k < currents_.size(); ++k)
      largest_[k] = std::max(largest_[k], std::abs(currents_[k]));
  }
  Vec2 swarm() {
    const std::lock_guard lock(mutex_);
    return physics_.ground_truth().swarm.pose.position;
  }
  /// What a probe at the centre shows now [mT].
  Eigen::Vector3d field() {
    const std::lock_guard lock(mutex_);
    const actuation::CoilSystem& system = on_.rig.system;
    return system.at(system.centre())
        .total_field(Eigen::Map<const Eigen::VectorXd>(currents_.data(),
                                                       static_cast<Eigen::Index>(system.size())));
  }
  /// The largest current of each channel since the last call [A].
  std::array<double, 6> largest() {
    const std::lock_guard lock(mutex_);
    return std::exchange(largest_, {});
  }

 private:
  void catch_up() {
    const double now = steady_seconds();
    physics_.start_trajectory();
    for (; now - at_ > 1e-6; at_ = std::min(now, at_ + 0.002))
      physics_.pass(currents_, std::min(0.002, now - at_));
  }
  void expose() {
    for (double due = steady_seconds(); !over_; due += 0.03) {
      std::this_thread::sleep_for(std::chrono::duration<double>(due - steady_seconds()));
      formats::Image picture;
      {
        std::unique_lock lock(mutex_);
        catch_up();
        rig::RigSimulator::Shot shot = physics_.capture();
        lock.unlock();
        if (shown_ != Scene::swarm) shot.swarm.reset();
        picture = physics_.render(shot);
      }
      if (shown_ == Scene::slide) draw_slide(picture);
      std::ofstream file(picture_.string() + ".new", std::ios::binary);
      file << "P5\n" << picture.width << ' ' << picture.height << "\n255\n";
      file.write(reinterpret_cast<const char*>(picture.pixels.data()),
                 static_cast<std::streamsize>(picture.pixels.size()));
      file.close();
      fs::rename(picture_.string() + ".new", picture_);
      ++exposed_;
    }
  }
  /// 9 × 7 dots, 210 µm apart.
  static void draw_slide(formats::Image& picture) {
    constexpr double pitch = 210 / um_per_px;
    for (int row = 0; row < picture.height; ++row)
      for (int column = 0; column < picture.width; ++column) {
        const double x = (column - 120) / pitch, y = (row - 90) / pitch;
        const double i = std::clamp(std::round(x), 0.0, 8.0),
                     j = std::clamp(std::round(y), 0.0, 6.0);
        if (std::hypot(x - i, y - j) < 0.2) picture.pixels[picture.index(column, row)] = 40;
      }
  }

  fs::path picture_;
  rig::RigExperiment on_;
  std::mutex mutex_;
  rig::RigSimulator physics_;
  std::vector<double> currents_ = std::vector<double>(6);
  std::array<double, 6> largest_{};
  double at_ = steady_seconds();
  std::atomic<Scene> shown_ = Scene::empty;
  std::atomic<int> exposed_ = 0;
  std::atomic<bool> over_ = false;
  std::thread camera_;
};

/// The commands of a page, in their order.
std::vector<std::string> commands_of(const fs::path& page) {
  std::vector<std::string> commands;
  std::istringstream lines(read_file(page));
  for (std::string line; std::getline(lines, line);)
    if (line.starts_with("    ")) commands.push_back(line.substr(4));
  return commands;
}

struct Said {
  int code = -1;
  std::string text;
};

/// Words of a command line; double quotes hold one together.
std::vector<std::string> words_of(const std::string& command) {
  std::vector<std::string> words{""};
  bool quoted = false;
  for (const char c : command) {
    if (c == '"')
      quoted = !quoted;
    else if (c == ' ' && !quoted)
      words.emplace_back();
    else
      words.back() += c;
  }
  return words;
}

class FirstRig : public testing::Test {
 protected:
  FirstRig()
      : folder(fs::path(testing::TempDir()) / ("microswarm_rig_" + std::to_string(getpid()))) {
    fs::remove_all(folder);
    fs::create_directories(folder / "firmware");
    const fs::path source = MICROSWARM_SOURCE_DIR;
    fs::copy(source / "firmware", folder / "firmware", fs::copy_options::recursive);
    fs::copy(source / "scenarios", folder / "scenarios", fs::copy_options::recursive);
  }
  ~FirstRig() override { fs::remove_all(folder); }

  /// Runs a command at a terminal; the probe shows the operator the field at the centre.
  Said run(const std::string& command, Bench* bench) const {
    std::vector<std::string> words = words_of(command);
    Surroundings at{.folder = folder};
    if (words[0] == "microswarm") {
      words[0] = MICROSWARM_PROGRAM;
      at.environment = {
          {"LD_PRELOAD", MICROSWARM_FAKE_CAMERA},
          {"ASAN_OPTIONS", "verify_asan_link_order=0"},
          {"FAKE_CAMERA",
           "device=/dev/video0 formats=YUYV,GREY width=640 height=480 rate=30 scene=" +
               (folder / "view.pgm").string()}};
    }
    Terminal terminal(words[0], {words.begin() + 1, words.end()}, at);
    if (command.starts_with("microswarm rig calibrate")) {
      if (terminal.hears("then Enter")) terminal.press("\r");
      for (int i = 0; terminal.hears_first("in mT: ", "worst"); ++i) {
        const Eigen::Vector3d b = bench->field();
        terminal.press(std::to_string(b[0]) + " " + std::to_string(b[1]) + " " +
                       std::to_string(b[2]) + "\r");
        if (i == 0 && terminal.hears("clamp meter")) terminal.press("\r");
      }
    }
    const int code = terminal.wait();
    return {code, terminal.said()};
  }
  void replace(const std::string& name, const std::string& before, const std::string& after) const {
    std::string text = read_file(folder / name);
    const std::size_t at = text.find(before);
    ASSERT_NE(at, std::string::npos) << name << ": " << before;
    text.replace(at, before.size(), after);
    write_file_atomically(folder / name, text);
  }

  fs::path folder;
};

TEST_F(FirstRig, FromABareBoardToARun) {
  if (access(BOOTLOADER, R_OK) != 0) GTEST_SKIP() << "no bootloader: install arduino-core-avr";
  if (std::system("command -v avrdude >/dev/null") != 0) GTEST_SKIP() << "install avrdude";
  // All of it is in real time; who may not do this needs an idle computer.
  ::setpriority(PRIO_PROCESS, 0, -15);
  std::unique_ptr<Bench> bench;
  std::mutex mutex;
  Simulator mega(BOOTLOADER, "-", [&](const Outputs& outputs) {
    const std::lock_guard lock(mutex);
    if (bench) bench->take(outputs);
  });
  ASSERT_NE(mega.port(), "");

  std::vector<std::string> done;
  for (std::string command :
       commands_of(fs::path(MICROSWARM_SOURCE_DIR) / "docs/tutorials/first-rig.md")) {
    const auto is = [&](std::string_view begins) { return command.starts_with(begins); };
    // What the operator does before it.
    if (is("microswarm") && !bench) {
      replace("my/bench.yaml", "/dev/ttyACM0", mega.port());
      // A busy computer stalls.
      replace("my/bench.yaml", "lost_swarm_s: 0.5, max_frame_age_s: 0.5, deadman_s: 0.5",
              "lost_swarm_s: 3, max_frame_age_s: 3, deadman_s: 3, max_pause_s: 3, max_trips: 50");
      const std::lock_guard lock(mutex);
      bench = std::make_unique<Bench>(folder / "my", folder / "view.pgm");
    }
    if (is("microswarm rig scale")) {
      replace("my/bench.yaml", "coils: helmholtz.yaml", "coils: coils.yaml");
      bench->show(Scene::slide);
    }
    if (is("microswarm rig still")) {
      const std::string found = read_file(folder / "my/scale.yaml");
      const std::string flow = "scale: {um_per_px: 4.2, origin_px: [-0.5, 479.5]}";
      replace("my/bench.yaml", flow, found);
      bench->show(Scene::empty);
    }
    if (is("microswarm rig see")) bench->show(Scene::swarm);
    if (const std::size_t at = command.find("/dev/ttyACM0"); at != std::string::npos)
      command.replace(at, 12, mega.port());
    const Vec2 before = bench ? bench->swarm() : Vec2{};
    if (bench) bench->largest();

    const double began = steady_seconds();
    Said said = run(command, bench.get());
    // A busy computer stalls for longer than the board's watchdog waits.
    for (int again = 0; said.code == 4 && again < 10; ++again) {
      fs::remove_all(folder / "my/run1");
      fs::remove_all(folder / "my/identify");
      said = run(command, bench.get());
    }
    if (std::getenv("MICROSWARM_VERBOSE"))
      std::printf("%.1f s: %s\n%s\n", steady_seconds() - began, command.c_str(), said.text.c_str());
    done.push_back(words_of(command)[0]);

    const bool dry = command.find("--dry-run") != std::string::npos;
    ASSERT_EQ(said.code, dry ? 3 : 0) << command << "\n" << said.text;
    if (is("microswarm rig drive")) {
      const std::array<double, 6> largest = bench->largest();
      for (const double current : {largest[0], largest[1], largest[2]})
        EXPECT_NEAR(current, 0.5, 0.03);
    }
    if (is("microswarm rig see")) {
      EXPECT_NE(said.text.find("found"), std::string::npos) << said.text;
    }
    if (dry) {
      EXPECT_EQ(bench->largest(), (std::array<double, 6>{}));
    }
    if (is("microswarm rig identify")) {
      const std::string found = read_file(folder / "my/bench.yaml");
      for (const char* key : {"speed_per_pitch_um_per_s: ", "heading_offset_deg: ", "delay_s: "})
        EXPECT_NE(found.find(key), std::string::npos) << found;
      EXPECT_LT(distance(bench->swarm(), before), 60);
      const std::string record = read_file(folder / "my/bench.commissioning.yaml");
      for (const char* what : {"field", "scale", "gain", "angle", "delay", "step_out"})
        EXPECT_NE(record.find(std::string("what: ") + what), std::string::npos) << record;
    }
    if (is("microswarm rig run") && !dry) {
      EXPECT_GT(bench->largest()[0], 1);
      EXPECT_LT(distance(bench->swarm(), Vec2{1550, 1000}), 30);
      EXPECT_GT(distance(bench->swarm(), before), 300);
    }
    EXPECT_EQ(mega.outputs(), off) << command;
  }
  EXPECT_EQ(std::ranges::count(done, "make"), 1);
  EXPECT_GE(std::ranges::count(done, "microswarm"), 8);
  const experiment::Record record = experiment::read_record(folder / "my/run1/run.h5");
  EXPECT_EQ(record.result.status, Status::solved);
  EXPECT_EQ(record.rig_log.note, "first run");
}

}  // namespace
}  // namespace microswarm::test
