// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdio>

#include "microswarm/core/maths/angles.hpp"
#include "tests/files.hpp"
#include "tests/firmware/raw_line.hpp"

namespace microswarm::test {

/// Expects of the device a field that rotates evenly at 100 Hz, on two channels, beside a constant
/// on a third, while the host asks for it again and again.
inline void expect_waveform(Simulator& mega) {
  using namespace std::chrono_literals;
  const Folder folder;
  RawLine line(mega.port());
  actuation::CoilAim aim{.frequency = 100'000, .constant = {0, 0, 250, 0, 0, 0}};
  aim.cosine[0] = 800;
  aim.sine[1] = 800;
  const auto send = [&] {
    return line.ask(actuation::encode_waveform(++line.sequence, line.last.clock + 1000, 0, aim))
        .result;
  };
  line.arm();
  ASSERT_EQ(send(), actuation::CoilResult::ok);
  std::this_thread::sleep_for(50ms);
  mega.order("trace " + (folder / "trace").string());
  for (int k = 0; k < 10; ++k) {
    EXPECT_EQ(send(), actuation::CoilResult::ok);
    std::this_thread::sleep_for(20ms);
  }
  mega.order("trace");
  // The channels change one after the other: of each tick the last line has them all.
  std::vector<Moment> ticks;
  for (const Moment& m : read_trace(folder / "trace"))
    if (!ticks.empty() && m.t - ticks.back().t < 100e-6)
      ticks.back() = m;
    else
      ticks.push_back(m);
  ASSERT_GT(ticks.size(), 300u);
  double before = std::atan2(ticks[1].y, ticks[1].x);
  double turned = 0, worst_step = 0;
  for (std::size_t k = 2; k + 1 < ticks.size(); ++k) {
    EXPECT_NEAR(std::hypot(ticks[k].x, ticks[k].y), 800, 12) << k;
    EXPECT_NEAR(ticks[k].z, 250, 2);
    const double angle = std::atan2(ticks[k].y, ticks[k].x);
    const double step = std::remainder(angle - before, 2 * pi);
    const double expected = 2 * pi * 100 * (ticks[k].t - ticks[k - 1].t);
    worst_step = std::max(worst_step, std::abs(step - expected));
    turned += step;
    before = angle;
  }
  const double seconds = ticks[ticks.size() - 2].t - ticks[1].t;
  EXPECT_NEAR(turned / (2 * pi) / seconds, 100, 0.5);
  EXPECT_LT(worst_step, 0.1);  // [rad]
  std::printf("%.3f Hz, worst step %.4f rad off, %zu ticks in %.3f s\n",
              turned / (2 * pi) / seconds, worst_step, ticks.size(), seconds);
  EXPECT_TRUE(mega.when(off));  // by silence
}

}  // namespace microswarm::test
