// SPDX-License-Identifier: Apache-2.0
// `rig run` under a manager of services: readiness, and signs of life of the loop that drives.
#include <cstdlib>

#include "driven_rig.hpp"
#include "notices.hpp"
#include "support/service_manager.hpp"

namespace microswarm::test {
namespace {

class RigService : public DrivenRig {
 protected:
  RigService() {
    write_rig(device);
    manager.ask(at, 200);
  }
  std::atomic<bool> is_silent = false;
  FakeDevice device{[this](actuation::CoilReply&) { return !is_silent; }};
  Notices manager{(at.folder / "notices").string()};
};

TEST_F(RigService, SignsOfLifeEndWithTheProgram) {
  Program program(arguments(), at);
  ASSERT_TRUE(manager.hears("READY=1"));
  manager.expect_signs_of(program);
  program.send(SIGINT);
  EXPECT_TRUE(manager.hears("STOPPING=1"));
  EXPECT_EQ(program.wait().code, 3);
  EXPECT_EQ(Notices::signs(manager.within(0)), 0);
}

TEST_F(RigService, ALoopThatHangsGivesNoSignThoughTheProgramRuns) {
  Program program(arguments({"--set-rig", "driver.reply_timeout_s=1"}), at);
  ASSERT_TRUE(manager.hears("READY=1"));
  EXPECT_TRUE(manager.hears("WATCHDOG=1"));
  is_silent = true;  // the loop waits for an answer
  manager.within(100);
  EXPECT_EQ(Notices::signs(manager.within(700)), 0);
}

TEST_F(RigService, AFaultIsItsLastStatus) {
  Program program(arguments({"--set-rig", "safety.max_pause_s=0.3"}), at);
  ASSERT_TRUE(manager.hears("READY=1"));
  program.send(SIGSTOP);
  sleep_ms(600);
  program.send(SIGCONT);
  EXPECT_TRUE(manager.hears("stood still"));
  EXPECT_EQ(program.wait().code, 4);
}

TEST_F(RigService, AManagerThatIsNotThereChangesNothing) {
  at.environment = {{"NOTIFY_SOCKET", (at.folder / "none").string()}, {"WATCHDOG_USEC", "200000"}};
  EXPECT_EQ(run(arguments({"--seconds", "1"})).code, 3);
}

TEST(ServiceManager, TheMainLoopIsSilentWhileTheCoilsAreDriven) {
  const std::string address = "@microswarm_service_test_" + std::to_string(::getpid());
  const Notices manager(address);
  ::setenv("NOTIFY_SOCKET", address.c_str(), 1);
  ::setenv("WATCHDOG_USEC", "20000", 1);
  cli::ServiceManager service;
  ::setenv("WATCHDOG_PID", "1", 1);  // asked of another process
  cli::ServiceManager other;
  for (const char* name : {"NOTIFY_SOCKET", "WATCHDOG_USEC", "WATCHDOG_PID"}) ::unsetenv(name);
  const std::vector<std::string> none;
  service.live();
  EXPECT_EQ(manager.within(0), none) << "it is not ready";
  service.ready();
  service.ready();
  service.live();
  service.live();  // too early
  EXPECT_EQ(manager.within(0), (std::vector<std::string>{"READY=1", "WATCHDOG=1"}));
  sleep_ms(12);
  service.drive();
  sleep_ms(12);
  service.live();
  const std::vector<std::string> driven{"STATUS=the coils are driven", "WATCHDOG=1"};
  EXPECT_EQ(manager.within(0), driven) << "the main loop speaks for that of the coils";
  service.rest("a fault");
  service.live();
  const std::vector<std::string> rests{"STATUS=the coils are not driven: a fault", "WATCHDOG=1"};
  EXPECT_EQ(manager.within(0), rests);
  service.status("two\nlines");
  EXPECT_EQ(manager.within(0), std::vector<std::string>{"STATUS=two?lines"});
  other.ready();
  other.live();
  EXPECT_EQ(manager.within(0), std::vector<std::string>{"READY=1"});
}

}  // namespace
}  // namespace microswarm::test
