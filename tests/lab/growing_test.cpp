// SPDX-License-Identifier: Apache-2.0
// Records that their run still writes.
#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include "lab/sessions/record_watch.hpp"
#include "microswarm/experiment/session/growing_record.hpp"
#include "tests/lab/client.hpp"

namespace microswarm::lab {
namespace {

/// A run that writes to a folder as the command line does.
class Writer {
 public:
  explicit Writer(const std::filesystem::path& folder)
      : folder_(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)),
        run_(experiment::open_experiment(experiment::small_flight(), {})) {
    EXPECT_EQ(::flock(folder_, LOCK_EX | LOCK_NB), 0);
  }
  ~Writer() { ::close(folder_); }
  Writer(const Writer&) = delete;
  Writer& operator=(const Writer&) = delete;

  void write(const std::filesystem::path& file, int ticks) {
    for (int i = 0; i < ticks; ++i) run_.step();
    run_.record_to(file);
  }
  experiment::Session& run() { return run_; }

 private:
  int folder_;
  experiment::Session run_;
};

TEST(GrowingRecords, AreFollowedToTheirEnd) {
  const Lab lab;
  const auto part = lab.folder / "run.part.h5";
  const auto whole = lab.folder / "run.h5";
  std::optional<Writer> writer(std::in_place, lab.folder / "");
  writer->write(part, 10);
  EXPECT_EQ(present_record(whole), part);
  TestPage page(lab, open(lab, {{"file", part.string()}}));
  const Json first = page.until("standing");
  EXPECT_EQ(first["growing"], true);
  EXPECT_EQ(first["status"], "running");
  EXPECT_EQ(page.latest["frame"]["number"], 9);  // the newest

  writer->write(part, 5);
  page.until("frame", [](const Json& frame) { return frame["number"] == 14; });
  EXPECT_EQ(page.latest["rows"]["rows"].get_binary().size(), 5 * 80u);

  // Whoever looks at an earlier frame goes on looking at it.
  page.does({{"do", "seek"}, {"number", 3}});
  writer->write(part, 5);
  const Json grown =
      page.until("standing", [](const Json& standing) { return standing["frames"] == 20; });
  EXPECT_EQ(grown["frame"], 3);
  page.does({{"do", "live"}});
  page.until("frame", [](const Json& frame) { return frame["number"] == 19; });

  writer->run().finish();
  writer->run().record_to(whole);
  std::filesystem::remove(part);
  const Json end =
      page.until("standing", [](const Json& standing) { return standing["growing"] == false; });
  EXPECT_EQ(end["status"], "solved");
  EXPECT_EQ(end["frames"], writer->run().record().frames.size());
  page.does({{"do", "restart"}, {"settings", Json::array()}});  // now of the whole
  EXPECT_EQ(page.latest["hello"]["playback"], true);
}

TEST(GrowingRecords, WhoseRunWasKilledDoNotGrow) {
  const Lab lab;
  const auto part = lab.folder / "run.part.h5";
  std::optional<Writer> writer(std::in_place, lab.folder / "");
  writer->write(part, 10);
  TestPage page(lab, open(lab, {{"file", part.string()}}));
  EXPECT_EQ(page.until("standing")["growing"], true);
  writer.reset();
  page.until("standing", [](const Json& standing) { return standing["growing"] == false; });
  page.does({{"do", "seek"}, {"number", 2}});
}

TEST(GrowingRecords, AFileInTheMakingOfAnotherRunBeginsAnew) {
  const Lab lab;
  const auto part = lab.folder / "run.part.h5";
  Writer writer(lab.folder / "");
  writer.write(part, 20);
  TestPage page(lab, open(lab, {{"file", part.string()}}));
  page.until("standing");
  experiment::Session other(experiment::open_experiment(experiment::small_flight(), {}));
  for (int i = 0; i < 4; ++i) other.step();
  other.record_to(part);
  EXPECT_FALSE(page.until("hello").is_null());
  EXPECT_EQ(page.until("standing")["frames"], 4);
}

}  // namespace
}  // namespace microswarm::lab
