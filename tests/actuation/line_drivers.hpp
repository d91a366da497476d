// SPDX-License-Identifier: Apache-2.0
// For the tests of drivers that speak the line protocol.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <string>
#include <vector>

#include "microswarm/actuation/drivers/line_coil_driver.hpp"
#include "microswarm/core/errors/error.hpp"
#include "tests/actuation/line_server.hpp"
#include "tests/messages.hpp"

namespace microswarm::actuation {

using Server = test::LineServer;
using Words = Server::Words;
inline const std::array<double, 3> amperes{1, -2.5, 0};

inline LineDriverParams quick() {
  LineDriverParams p;
  p.reply_timeout = 0.3;
  p.connect_timeout = 2;
  return p;
}

template <class Open>
void refuses(Open&& open, const std::string& position, const std::vector<std::string>& parts) {
  try {
    open();
    FAIL() << position;
  } catch (const HardwareError& e) {
    EXPECT_TRUE(test::is_one_line_naming(e.what(), position, parts));
  }
}

}  // namespace microswarm::actuation
