// SPDX-License-Identifier: Apache-2.0
// A run as one file that plays.
#include "lab/player/run_page.hpp"

#include <gtest/gtest.h>
#include <zlib.h>

#include <atomic>
#include <nlohmann/json.hpp>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/text/file.hpp"
#include "microswarm/experiment/session/session.hpp"
#include "tests/experiment/scenes.hpp"
#include "tests/files.hpp"

namespace microswarm::lab {
namespace {

using Json = nlohmann::json;

/// A radar's run with diagnostics and a change.
experiment::Record flown(const std::string& name = "Flight", int ticks = 30) {
  experiment::Scenario scenario = experiment::small_flight();
  scenario.name = name;
  const test::Folder folder;
  const auto file = folder.with("flight.yaml", experiment::scenario_text(scenario));
  const auto session = experiment::open_session(
      file,
      Settings(std::vector<std::string>{"navigator.type=radar", "record.diagnostics=true"}, ""));
  for (int i = 0; i < ticks; ++i) {
    if (i == 10) session->set("goal_tolerance_um", "31");
    session->step();
  }
  return experiment::Record(session->record());
}

std::string between(const std::string& text, std::string_view begin, std::string_view end) {
  const std::size_t from = text.find(begin) + begin.size();
  return text.substr(from, text.find(end, from) - from);
}

std::string from_base64(const std::string& text) {
  std::string bytes;
  std::uint32_t bits = 0;
  int count = 0;
  for (const char c : text) {
    const std::size_t digit =
        std::string_view("ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/")
            .find(c);
    if (digit == std::string_view::npos) break;
    bits = bits << 6U | static_cast<std::uint32_t>(digit);
    if ((count += 6) < 8) continue;
    count -= 8;
    bytes += static_cast<char>(bits >> count & 255U);
  }
  return bytes;
}

std::string unzipped(std::string packed) {
  z_stream from{};
  ::inflateInit2(&from, 15 + 16);
  from.next_in = reinterpret_cast<Bytef*>(packed.data());
  from.avail_in = static_cast<uInt>(packed.size());
  std::string bytes(std::size_t{64} << 20, '\0');
  from.next_out = reinterpret_cast<Bytef*>(bytes.data());
  from.avail_out = static_cast<uInt>(bytes.size());
  EXPECT_EQ(::inflate(&from, Z_FINISH), Z_STREAM_END);
  bytes.resize(from.total_out);
  ::inflateEnd(&from);
  return bytes;
}

struct Written {
  RunPage page;
  std::string html;
  Json run;  ///< the container
  Json message(const Json& bytes) const { return Json::from_cbor(bytes.get_binary()); }
};

Written written(const experiment::Record& record, const RunPageOptions& options = {}) {
  const test::Folder folder;
  const auto file = folder / "run.html";
  Written made{.page = write_run_page(record, file, options), .html = read_file(file)};
  const std::string text = between(made.html, "id=\"run\">", "</script>");
  made.run = Json::from_cbor(unzipped(from_base64(text)));
  return made;
}

TEST(RunPage, HasEveryFrameWithItsDecisionAndValues) {
  const experiment::Record record = flown();
  const Written made = written(record);
  EXPECT_EQ(made.page.frames, record.frames.size());
  EXPECT_EQ(made.page.bytes, made.html.size());
  ASSERT_EQ(made.run["frames"].size(), record.frames.size());
  for (const std::size_t i : {std::size_t{0}, std::size_t{17}, record.frames.size() - 1}) {
    const Json frame = made.message(made.run["frames"][i]);
    EXPECT_EQ(frame["number"], i);
    EXPECT_EQ(frame["frame"]["t_s"], record.frames[i].t);
    ASSERT_TRUE(frame.contains("radar")) << i;
    EXPECT_GT(frame["radar"]["beams"].get_binary().size(), 0u);
  }
  const Json& values = made.run["scenario"];
  ASSERT_EQ(values.size(), 2u);
  EXPECT_EQ(values[1][0], 10);
  EXPECT_EQ(made.message(values[1][1])["scenario"]["goal_tolerance_um"], 31);
  EXPECT_EQ(made.message(made.run["hello"])["command"], "microswarm replay run.h5");
  const Json rows = made.message(made.run["rows"]);
  EXPECT_EQ(rows["rows"].get_binary().size(), 8 * rows["columns"].size() * record.frames.size());
  EXPECT_EQ(made.run["hash"], record.hash());
}

TEST(RunPage, TextOfARecordStaysText) {
  const std::string name = "</script><script>alert(1)</script><!-- <b>&amp;";
  const Written made = written(flown(name, 3));
  EXPECT_EQ(made.html.find("alert(1)</script>"), std::string::npos);
  EXPECT_EQ(made.html.find("<b>"), std::string::npos);
  EXPECT_NE(made.html.find("&lt;script&gt;alert(1)"), std::string::npos);
  EXPECT_EQ(made.message(made.run["hello"])["scenario"]["name"], name);
  std::size_t ends = 0;
  for (std::size_t at = 0; (at = made.html.find("</script", at)) != std::string::npos; ++at) ++ends;
  EXPECT_EQ(ends, 2u);
}

TEST(RunPage, LeavesFramesOutEvenlyWithinItsLimit) {
  const experiment::Record record = flown("Flight", 200);
  const std::size_t limit = 300'000;
  const Written made = written(record, {.max_bytes = limit});
  ASSERT_GT(made.page.every, 1u);
  EXPECT_EQ(made.run["every"], made.page.every);
  EXPECT_EQ(made.run["frames"].size(), made.page.frames);
  std::size_t bytes = 0;
  for (const Json& frame : made.run["frames"]) bytes += frame.get_binary().size();
  EXPECT_LE(bytes, limit);
  EXPECT_GT(bytes, limit / 4);
  const std::size_t last = made.page.frames - 1;
  EXPECT_EQ(made.message(made.run["frames"][1])["frame"]["t_s"], record.frames[made.page.every].t);
  EXPECT_EQ(made.message(made.run["frames"][last])["frame"]["t_s"], record.frames.back().t);
  EXPECT_EQ(made.message(made.run["standing"])["frames"], made.page.frames);
}

TEST(RunPage, RefusesWhatItCannotShow) {
  const experiment::Record record = flown();
  const test::Folder folder;
  const auto file = folder / "run.html";
  EXPECT_THROW(write_run_page({}, file), InputError);
  EXPECT_THROW(write_run_page(record, file, {.max_bytes = 10'000}), InputError);
  const std::atomic<bool> yes = true;
  EXPECT_TRUE(write_run_page(record, file, {}, Stop(&yes)).stopped);
  EXPECT_FALSE(std::filesystem::exists(file));
}

}  // namespace
}  // namespace microswarm::lab
