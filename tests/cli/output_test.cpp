// SPDX-License-Identifier: Apache-2.0
// Results that cannot be written: one line, exit code 2, and no part of a file is left behind.
#include <fcntl.h>
#include <sys/file.h>

#include <stop_token>
#include <thread>

#include "inputs.hpp"
#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/execution/descriptor.hpp"
#include "program.hpp"
#include "support/cli.hpp"

namespace microswarm::test {
namespace {

const std::string disk_full = ": cannot write: No space left on device";
const std::string too_large = ": cannot write: File too large";

class Output : public CommandLine {
 protected:
  Output() {
    write("flight.yaml", two_rooms());
    write("room.pgm", pgm(60, 40, [](int x, int y) { return x == 30 && y < 20 ? 0 : 255; }));
  }
  Arguments plan(const std::string& picture) const {
    return {"plan",    "room.pgm", "--um-per-px", "10",        "--start",
            "100,200", "--goal",   "500,200",     "--picture", picture};
  }
};

TEST_F(Output, FullDisk) {
  at.out = "/dev/full";
  refused({"schema"}, "stdout" + disk_full);
  refused({"map", "info", "room.pgm", "--um-per-px", "5"}, "stdout" + disk_full);
  refused({"run", "flight.yaml"}, "stdout" + disk_full);
  at.out.clear();
  fs::create_symlink("/dev/full", at.folder / "full.png");
  fs::create_symlink("/dev/full", at.folder / "full.geojson");
  refused(plan("full.png"), "full.png" + disk_full);
  refused({"map", "convert", "room.pgm", "--um-per-px", "5", "full.geojson"},
          "full.geojson" + disk_full);
}

// As `rig queue --status` and the lab do, again and again.
TEST_F(Output, WhoLooksWhetherAFolderIsLockedKeepsNobodyOut) {
  std::jthread looks([&](const std::stop_token& stop) {
    while (!stop.stop_requested()) {
      const Descriptor folder = open_descriptor(at.folder, O_RDONLY | O_DIRECTORY);
      ::flock(folder.get(), LOCK_SH | LOCK_NB);
    }
  });
  for (int k = 0; k < 300; ++k) EXPECT_NO_THROW(cli::OutFolder{at.folder.string()}) << k;
  looks.request_stop();
  looks.join();
  const cli::OutFolder first(at.folder.string());
  EXPECT_THROW(cli::OutFolder{at.folder.string()}, InputError);
}

TEST_F(Output, DiskFullBeforeARecordIsWhole) {
  at.largest_file = 4096;
  fs::create_directory(at.folder / "out");
  const Outcome outcome = run({"run", "flight.yaml", "--out", "out"});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_EQ(outcome.err, "microswarm: out/run.h5" + too_large + "\n");
  EXPECT_TRUE(outcome.out.starts_with("goal reached after")) << outcome.out;  // told all the same
  EXPECT_EQ(outcome.out.find("wrote"), std::string::npos);
}

TEST_F(Output, DiskFullAmongThePictures) {
  std::set<std::string> whole{"run.h5", "plots.png", "index.html"};
  for (const char* picture : {"overview", "moment-1"})
    for (const char* kind : {".png", ".svg", ".pdf"}) whole.insert(std::string(picture) + kind);
  good({"run", "flight.yaml", "--out", "out"});
  std::set<std::uint64_t> sizes;
  for (const std::string& name : whole) sizes.insert(fs::file_size(at.folder / "out" / name));
  for (const std::uint64_t size : sizes) {  // each time another file is the first not to fit
    fs::remove_all(at.folder / "page");
    at.largest_file = size - 1;
    const Outcome outcome = run({"report", "out/run.h5", "--out", "page"});
    if (outcome.code == 0) continue;  // the record itself was the largest
    EXPECT_EQ(outcome.code, 2);
    EXPECT_TRUE(outcome.err.ends_with(too_large + "\n")) << outcome.err;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    for (const std::string& name : files())
      EXPECT_TRUE(!name.starts_with("page/") || whole.contains(name.substr(5))) << name;
  }
}

TEST_F(Output, NoControlCharacterReachesTheTerminal) {
  const std::string evil = "\x1b]0;title\x07.yaml";
  const auto clean = [](const Outcome& outcome) {
    EXPECT_EQ(outcome.out.find('\x1b'), std::string::npos) << outcome.out;
    EXPECT_EQ(outcome.err.find('\x1b'), std::string::npos) << outcome.err;
    EXPECT_EQ(outcome.err.find('\x07'), std::string::npos) << outcome.err;
  };
  clean(run({"run", evil}));
  write(evil, "map: {}\n");
  clean(run({"run", evil}));
  clean(run({"run", "x.yaml", "--set", "a\x1b[31m=1"}));
  clean(run({"map", "info", evil}));
  fs::create_directories(at.folder / "pictures");
  write("pictures/\x1b[2J.png", "none");
  clean(run({"track", "pictures", "--um-per-px", "1", "--out", "out"}));
}

TEST_F(Output, FolderThatIsAFile) {
  write("file", "");
  const std::string reason = ": cannot make the folder: Not a directory";
  refused({"run", "flight.yaml", "--out", "file/out"}, "file/out" + reason);
  refused({"run", "flight.yaml", "--out", "file"}, "file" + reason);
  refused({"reproduce", "drrt/fig5a", "--out", "file/out"}, "file/out" + reason);
  refused(plan("file/path.png"), "file/path.png: cannot write: Not a directory");
  write("channel.pgm", pgm(60, 40, [](int x, int) { return x >= 25 && x < 35 ? 60 : 200; }));
  refused({"map", "segment", "channel.pgm", "--um-per-px", "5", "--out", "file/a.geojson"},
          "file" + reason);
  refused({"map", "convert", "room.pgm", "--um-per-px", "5", "none/a.png"},
          "none/a.png: cannot write: No such file or directory");
}

TEST_F(Output, FolderWhereNothingCanBeMade) {
  refused({"run", "flight.yaml", "--out", "/proc/microswarm"},
          naming("/proc/microswarm", {"folder"}));
  refused(plan("/proc/path.png"), "/proc/path.png: cannot write: No such file or directory");
}

TEST_F(Output, UnknownKindOfFile) {
  refused(plan("path.gif"), naming("path.gif", {"picture"}));
  refused({"map", "convert", "room.pgm", "--um-per-px", "5", "room.bmp"},
          naming("room.bmp", {"MovingAI", "ROS"}));
}

TEST_F(Output, WithoutGnuplot) {
  at.path = at.folder;
  const Outcome outcome = run({"run", "flight.yaml", "--out", "out"});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_EQ(outcome.err, "microswarm: out/plots.png: cannot plot: gnuplot is missing or failed\n");
  EXPECT_FALSE(exists("out/plots.png"));
}

}  // namespace
}  // namespace microswarm::test
