// SPDX-License-Identifier: Apache-2.0
// The state of a rig's queue in the lab.
#include "lab/net/server.hpp"
#include "microswarm/rig/queue/queue_state.hpp"
#include "tests/lab/client.hpp"

namespace microswarm::lab {
namespace {

TEST(LabQueue, IsShownAsItsStateSays) {
  const test::Folder folder;
  const Lab lab({.queue = folder / ""});
  EXPECT_TRUE(Json::parse(get(lab, "/api/scenarios").body())["queue"]);
  const Json before = Json::parse(get(lab, "/api/queue").body());
  EXPECT_EQ(before["doing"], "no queue has begun here yet");
  rig::QueueState state{.doing = "cooling", .active = true};
  state.items.push_back({.name = "one", .state = rig::ItemState::cooling});
  rig::write_queue_state(folder / "", state);
  const Json now = Json::parse(get(lab, "/api/queue").body());
  EXPECT_EQ(now["items"][0]["state"], "cooling");
  EXPECT_FALSE(now["active"]) << "nobody has locked the folder";
  EXPECT_EQ(get(Lab(), "/api/queue").result(), http::status::not_found);
}

}  // namespace
}  // namespace microswarm::lab
