// SPDX-License-Identifier: Apache-2.0
// Files from pages: what is kept, what is refused, and what is left of them.
#include "lab/files/uploads.hpp"

#include <fmt/format.h>
#include <stdlib.h>  // mkdtemp

#include <chrono>
#include <fstream>

#include "lab/files/photograph.hpp"
#include "tests/lab/client.hpp"

namespace microswarm::lab {
namespace {

namespace fs = std::filesystem;

std::string sample() { return read_file(test::sample_folder() / "vessels/retina.png"); }

Reply send(const Lab& lab, const std::string& name, const std::string& bytes) {
  return ask(lab, http::verb::post, "/api/uploads?name=" + name, bytes);
}

std::size_t files_in(const fs::path& folder) {
  return static_cast<std::size_t>(
      std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

TEST(Uploads, AScenarioThatWouldTakeLongToReadIsRefused) {
  const Lab lab;
  const std::string large(2 * 1024 * 1024 + 1, '#');
  const Reply sent = send(lab, "large.yaml", large);
  EXPECT_EQ(sent.result(), http::status::bad_request);
  EXPECT_NE(sent.body().find("2 MiB"), std::string::npos) << sent.body();
  EXPECT_NE(sent.body().find("large.yaml"), std::string::npos) << sent.body();
}

TEST(Uploads, APhotographBecomesAnExperiment) {
  fs::path folder;
  {
    const Lab lab;
    const Reply sent = send(lab, "../../my%20eye.png", sample());
    ASSERT_EQ(sent.result(), http::status::ok) << sent.body();
    const Json photo = Json::parse(sent.body());
    EXPECT_EQ(photo["kind"], "photograph");
    EXPECT_EQ(photo["width_px"], 200);
    const fs::path file = photo["file"].get<std::string>();
    folder = file.parent_path();
    EXPECT_EQ(file.filename(), "upload-1.png");
    EXPECT_EQ(fs::status(folder).permissions() & fs::perms::mask, fs::perms::owner_all);
    const Reply found =
        ask(lab, http::verb::post, "/api/vessels", Json{{"file", photo["file"]}}.dump());
    ASSERT_EQ(found.result(), http::status::ok) << found.body();
    EXPECT_EQ(found.body().substr(1, 3), "PNG");
    const Json numbers = Json::parse(found["Microswarm-Vessels"].to_string());
    EXPECT_GT(numbers["view_share"], 0.1);
    EXPECT_GT(numbers["swarm_share"], 0.3);
    EXPECT_LT(numbers["swarm_share"], 1);
    for (const Json& more : {Json{{"robots", 16}}, Json{{"start", {200, 480}}}}) {
      Json asked{{"file", photo["file"]}, {"um_per_px", 5}, {"goal", {450, 480}}};
      asked.update(more);
      const Reply made = ask(lab, http::verb::post, "/api/photographs", asked.dump());
      ASSERT_EQ(made.result(), http::status::ok) << made.body();
      Json opened = Json::parse(made.body());
      opened["photo"] = photo["file"];
      opened["um_per_px"] = 5;
      const std::uint64_t session = open(lab, opened);
      TestPage page(lab, session);
      page.next();
      EXPECT_EQ(page.latest["hello"]["photo"]["um_per_px"], 5.0);
      const std::string path = "/api/sessions/" + std::to_string(session);
      EXPECT_EQ(get(lab, path + "/photo.jpg").body().substr(0, 2), "\xff\xd8");
      page.does({{"do", "step"}});
      EXPECT_NE(get(lab, path + "/picture.svg").body().find("<image"), std::string::npos);
    }
    for (const Json& wrong :
         {Json{{"um_per_px", 5}}, Json{{"um_per_px", 5}, {"goal", {450, 480}}},
          Json{{"goal", {450, 480}}, {"robots", 3}},
          Json{{"um_per_px", 5}, {"goal", {5, 5}}, {"robots", 3}},
          Json{{"um_per_px", 5}, {"goal", {1, 2, 3}}, {"robots", 3}},
          Json{
              {"settings", {"threshold=-1"}}, {"um_per_px", 5}, {"goal", {1, 2}}, {"robots", 3}}}) {
      Json asked = wrong;
      asked["file"] = photo["file"];
      const Reply refused = ask(lab, http::verb::post, "/api/photographs", asked.dump());
      EXPECT_EQ(refused.result(), http::status::bad_request) << wrong;
    }
    EXPECT_EQ(ask(lab, http::verb::post, "/api/vessels", R"({"file": "/etc/passwd"})").result(),
              http::status::bad_request);
  }
  EXPECT_FALSE(fs::exists(folder));
}

TEST(Uploads, WhatIsNoneOfThemLeavesNothing) {
  const Lab lab;
  const Json first = Json::parse(send(lab, "a.png", sample()).body());
  const fs::path folder = fs::path(first["file"].get<std::string>()).parent_path();
  const std::string whole = sample();
  const std::string elsewhere =
      "name: x\nmap: {type: image, file: /etc/hostname, um_per_px: 1}\nswarm: {type: ribbon}\n"
      "start: {x_um: 1, y_um: 1, heading_deg: 0}\ngoal_um: [2, 2]\n";
  for (const auto& [name, bytes] : {std::pair<std::string, std::string>{"a.png", "hello"},
                                    {"a.png", whole.substr(0, whole.size() / 2)},
                                    {"a.tif", whole.substr(0, 9)},
                                    {"a.yaml", "name: [1"},
                                    {"a.yaml", elsewhere},
                                    {"a.h5", "hello"},
                                    {"a.txt", "hello"},
                                    {"", "hello"},
                                    {"a.png", ""}}) {
    const Reply reply = send(lab, name, bytes);
    EXPECT_EQ(reply.result(), http::status::bad_request) << name;
    const std::string error = Json::parse(reply.body())["error"];
    EXPECT_EQ(error.find(folder.string()), std::string::npos) << error;
  }
  EXPECT_EQ(files_in(folder), 1u);
}

TEST(Uploads, ALargeBodyIsOnlyForThemAndNeedsTheToken) {
  const Lab lab;
  const std::string large(1 << 20, 'x');
  EXPECT_EQ(ask(lab, http::verb::post, "/api/sessions", large).result(),
            http::status::payload_too_large);
  EXPECT_EQ(send(lab, "a.txt", large).result(), http::status::bad_request);
}

TEST(TemporaryFiles, OnesThatAKilledProgramLeftAreRemoved) {
  const TemporaryFile used("a");
  std::string left = (fs::temp_directory_path() / "microswarm-XXXXXX").string();
  std::string young = left;
  ASSERT_TRUE(::mkdtemp(left.data()) && ::mkdtemp(young.data()));
  std::ofstream(fs::path(left) / "upload-1.png") << "x";
  const auto long_ago = fs::file_time_type::clock::now() - std::chrono::hours(1);
  fs::last_write_time(left, long_ago);
  fs::last_write_time(used.path().parent_path(), long_ago);
  remove_left_folders();
  EXPECT_FALSE(fs::exists(left));
  EXPECT_TRUE(fs::exists(young));
  EXPECT_TRUE(fs::exists(used.path().parent_path()));
  fs::remove(young);
}

TEST(Uploads, AScenarioAndARecordAreOpened) {
  const Lab lab;
  const Reply scenario = send(lab, "flight.yml", read_file(lab.file));
  ASSERT_EQ(scenario.result(), http::status::ok) << scenario.body();
  EXPECT_NE(open(lab, {{"file", Json::parse(scenario.body())["file"]}}), 0u);
  const auto session = experiment::open_session(lab.file);
  session->finish();
  session->record_to(lab.folder / "run.h5");
  const Reply record = send(lab, "run.h5", read_file(lab.folder / "run.h5"));
  ASSERT_EQ(record.result(), http::status::ok) << record.body();
  EXPECT_EQ(Json::parse(record.body())["kind"], "record");
}

}  // namespace
}  // namespace microswarm::lab
