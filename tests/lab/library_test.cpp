// SPDX-License-Identifier: Apache-2.0
#include "lab/files/library.hpp"

#include <gtest/gtest.h>

#include "lab/files/thumbnail.hpp"
#include "tests/experiment/scenes.hpp"
#include "tests/files.hpp"
#include "tests/messages.hpp"

namespace microswarm::lab {
namespace {

namespace fs = std::filesystem;
using test::error_of;

/// A folder with a scenario, a file beside it, and a library of the first.
struct Shelf {
  Shelf() {
    fs::create_directories(folder / "in/deep");
    fs::create_directories(folder / "inside");
    scenario = folder.with("in/flight.yaml", experiment::scenario_text(experiment::small_flight()));
    folder.with("in/deep/other.yaml", experiment::scenario_text(experiment::small_flight()));
    secret = folder.with("secret.csv", "1,2,3,4\n");
    folder.with("inside/near.yaml", experiment::scenario_text(experiment::small_flight()));
  }
  test::Folder folder;
  fs::path scenario;
  fs::path secret;
  Library library() const { return Library({folder / "in"}); }
};

TEST(Library, ListsScenariosAndRecords) {
  const Shelf shelf;
  shelf.folder.with("in/rig.yaml", "camera: {type: simulated}\n");
  shelf.folder.with("in/run.h5", "x");
  shelf.folder.with("in/notes.txt", "x");
  const auto entries = shelf.library().entries();
  ASSERT_EQ(entries.size(), 3u);
  EXPECT_TRUE(entries[0].file.ends_with("in/deep/other.yaml"));
  EXPECT_TRUE(entries[1].file.ends_with("in/flight.yaml"));
  EXPECT_EQ(entries[1].name, experiment::small_flight().name);
  EXPECT_TRUE(entries[2].file.ends_with("in/run.h5"));
  EXPECT_EQ(Library({shelf.folder / "in", shelf.folder / "in/deep"}).entries().size(), 3u);
  for (const Entry& entry : entries) EXPECT_EQ(shelf.library().find(entry.file), entry.file);
}

TEST(Library, ListsScenariosWithMistakesAndWhatARecordIsOf) {
  const test::Folder folder;
  std::string text = experiment::scenario_text(experiment::small_flight());
  folder.with("broken.yaml", text + "  odd: [1, 2\n");
  folder.with("wrong.yaml", text + "no_such_key: 1\n");
  folder.with("other.yaml", "services: [a, b\n");
  const fs::path file = folder.with("flight.yaml", text);
  const auto session = experiment::open_session(file);
  session->finish();
  session->record_to(folder / "run.h5");
  folder.with("torn.h5", "x");
  const auto entries = Library({folder / ""}).entries();
  ASSERT_EQ(entries.size(), 5u);
  EXPECT_TRUE(entries[0].trouble.starts_with("broken.yaml:")) << entries[0].trouble;
  EXPECT_EQ(entries[1].trouble, "");
  EXPECT_TRUE(entries[2].record);
  EXPECT_EQ(entries[2].outcome, to_string(session->result().status));
  EXPECT_EQ(entries[2].description, session->scenario().name);
  EXPECT_FALSE(entries[2].navigator.empty());
  EXPECT_EQ(entries[2].written.size(), 16u);
  EXPECT_TRUE(test::is_one_line_naming(entries[3].trouble, "torn.h5", {}));
  EXPECT_NE(entries[4].trouble.find("no_such_key"), std::string::npos) << entries[4].trouble;
  // The path travelled is on the picture.
  EXPECT_NE(thumbnail(folder / "run.h5").find("fill=\"none\" stroke="), std::string::npos);
}

TEST(Library, RobotsAreDrawnWhereTheyBegin) {
  const fs::path gather =
      fs::path(MICROSWARM_SOURCE_DIR) / "scenarios/papers/gather/vascular_network.yaml";
  const std::string svg = thumbnail(gather);
  std::size_t count = 0;
  for (std::size_t at = svg.find("<circle"); at != std::string::npos;
       at = svg.find("<circle", at + 1))
    ++count;
  EXPECT_EQ(count, 65u);  // and the goal
}

TEST(Library, NoFileOutsideIsOpened) {
  const Shelf shelf;
  const Library library = shelf.library();
  fs::create_symlink(shelf.secret, shelf.folder / "in/link.yaml");
  fs::create_directory_symlink(shelf.folder / "inside", shelf.folder / "in/way");
  const std::string in = (shelf.folder / "in").string();
  for (const std::string& file :
       {shelf.secret.string(), in + "/../secret.csv", in + "/deep/../../secret.csv",
        in + "/link.yaml", in + "/way/near.yaml", (shelf.folder / "inside/near.yaml").string(), in,
        in + "/", in + "/deep", in + "/none.yaml", std::string("/etc/passwd"), std::string("../.."),
        std::string(), std::string("/"), std::string("/dev/zero"), in + "/flight.yaml/",
        std::string("a\0b", 3), std::string(100'000, 'a')})
    EXPECT_TRUE(test::is_one_line_naming(experiment::error_of([&] { library.find(file); }), "", {}))
        << file.substr(0, 200);
  EXPECT_EQ(library.find(in + "/deep/../flight.yaml"), shelf.scenario);
}

TEST(Library, NoSettingNamesAFileOutside) {
  const Shelf shelf;
  const Library library = shelf.library();
  const auto refused = [&](const std::string& setting) {
    return experiment::error_of([&] { library.check(shelf.scenario, {setting}); });
  };
  const std::string outside = "map={type: rectangles, lo_um: [0, 0], hi_um: [9, 9], file: ";
  for (const std::string& file : {std::string("../secret.csv"), shelf.secret.string()})
    EXPECT_TRUE(test::is_one_line_naming(refused(outside + file + "}"), "", {"no such file"}));
  EXPECT_NE(refused("obstacles=[{shape: {type: disc, radius_um: 3}, motion: {type: track, file: "
                    "../secret.csv, id: a}}]"),
            "nothing was thrown");
  library.check(shelf.scenario, {"seed=3"});
  shelf.folder.with("in/walls.csv", "1,2,3,4\n");
  library.check(shelf.scenario, {outside + "walls.csv}"});
  // What the command line named, it may name again.
  const std::string trusted = outside + shelf.secret.string() + "}";
  library.check(shelf.scenario, {trusted, "seed=3"}, {trusted});
}

TEST(Library, AFolderThatIsNotThereIsTold) {
  EXPECT_TRUE(test::is_one_line_naming(experiment::error_of([] { Library({"/no/such"}); }),
                                       "/no/such", {}));
}

TEST(Thumbnail, IsSmallForEveryShippedScenario) {
  const Library shipped({fs::path(MICROSWARM_SOURCE_DIR) / "scenarios"});
  ASSERT_GT(shipped.entries().size(), 10u);
  for (const Entry& entry : shipped.entries()) {
    const std::string svg = thumbnail(entry.file);
    EXPECT_TRUE(svg.starts_with("<svg ") && svg.ends_with("</svg>\n")) << entry.file;
    EXPECT_LE(svg.size(), 200'000u) << entry.file;
    EXPECT_EQ(svg.find("nan"), std::string::npos) << entry.file;
    EXPECT_NE(svg.find("#8a3fd1"), std::string::npos) << entry.file << " has no goal";
  }
}

TEST(Thumbnail, IsDrawnAnewWhenTheFileChanges) {
  const Shelf shelf;
  Thumbnails thumbnails;
  const std::string first = thumbnails.of(shelf.scenario);
  EXPECT_EQ(thumbnails.of(shelf.scenario), first);
  experiment::Scenario moved = experiment::small_flight();
  moved.goal->x -= 300;
  shelf.folder.with("in/flight.yaml", experiment::scenario_text(moved));
  fs::last_write_time(shelf.scenario, fs::file_time_type::clock::now() + std::chrono::seconds(2));
  EXPECT_NE(thumbnails.of(shelf.scenario), first);
}

}  // namespace
}  // namespace microswarm::lab
