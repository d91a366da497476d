// SPDX-License-Identifier: Apache-2.0
#include "microswarm/core/execution/priority.hpp"

#include <gtest/gtest.h>
#include <sched.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <thread>

namespace microswarm {
namespace {

int priority() {
  sched_param param{};
  ::sched_getparam(0, &param);
  return ::sched_getscheduler(0) == SCHED_RR ? param.sched_priority : 0;
}

TEST(Priority, IsTheThreadsAndItsThreadsUntilItsEnd) {
  {
    const RealtimePriority none(0);
    EXPECT_TRUE(none.is_permitted());
    EXPECT_EQ(priority(), 0);
  }
  {
    const RealtimePriority raised(10);
    const int now = raised.is_permitted() ? 10 : 0;
    EXPECT_EQ(priority(), now);
    {
      const RealtimePriority less(5);  // the thread may have more already
      EXPECT_EQ(less.is_permitted(), raised.is_permitted());
      EXPECT_EQ(priority(), now);
    }
    EXPECT_EQ(priority(), now);
    int inherited = -1, lowered = -1;
    std::thread([&] {
      inherited = priority();
      lower_priority();
      lowered = priority();
    }).join();
    EXPECT_EQ(inherited, now);
    EXPECT_EQ(lowered, 0);
  }
  EXPECT_EQ(priority(), 0);
}

TEST(Priority, IsNotInheritedIfThatIsNotMeant) {
  const RealtimePriority raised(10, RealtimePriority::Inherited::no);
  int inherited = -1;
  std::thread([&] { inherited = realtime_priority(); }).join();
  EXPECT_EQ(inherited, 0);
  EXPECT_EQ(realtime_priority(), raised.is_permitted() ? 10 : 0);
}

TEST(Priority, WithoutPermissionNothingChanges) {
  bool permitted = true;
  int after = -1;
  std::thread([&] {
    constexpr int unchanged = -1, ordinary_user = 65534;
    // By the system call, for this thread alone; it loses its capabilities.
    if (::geteuid() == 0) ::syscall(SYS_setresuid, unchanged, ordinary_user, unchanged);
    const RealtimePriority raised(98);
    permitted = raised.is_permitted();
    after = priority();
  }).join();
  rlimit most{};
  ::getrlimit(RLIMIT_RTPRIO, &most);
  if (most.rlim_cur >= 98) GTEST_SKIP() << "this user may have every priority";
  EXPECT_FALSE(permitted);
  EXPECT_EQ(after, 0);
}

}  // namespace
}  // namespace microswarm
