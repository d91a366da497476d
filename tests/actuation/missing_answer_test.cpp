// SPDX-License-Identifier: Apache-2.0
#include "microswarm/actuation/drivers/missing_answer.hpp"

#include <gtest/gtest.h>

namespace microswarm::actuation {
namespace {

void hear(MissingAnswer& missing, std::string_view text) {
  for (const char c : text) missing.take(static_cast<std::uint8_t>(c));
}

TEST(MissingAnswer, SaysWhatCameInItsPlace) {
  MissingAnswer missing(0.02);
  missing.expect(1, 0);
  EXPECT_EQ(missing.text(), "it accepts no bytes");
  missing.sent();
  missing.sent();
  EXPECT_EQ(missing.text(), "nothing came back, messages sent: 2");
  hear(missing, "\x1b[2Jhi\n");
  EXPECT_EQ(missing.text(), "it said '?[2Jhi', which is no answer");
  missing.expect(2, 0.1);
  missing.sent();
  EXPECT_EQ(missing.text(), "nothing came back, messages sent: 1");
  missing.other(77, 0.11);
  EXPECT_EQ(missing.text(), "it answered another message");
}

TEST(MissingAnswer, AFloodIsCounted) {
  MissingAnswer missing(0.02);
  missing.expect(1, 0);
  missing.sent();
  hear(missing, std::string(501, 'x'));
  EXPECT_EQ(missing.text(),
            "it floods the line, 501 bytes without an answer: '" + std::string(60, 'x') + "…'");
}

TEST(MissingAnswer, ALateAnswerIsSaidUntilOneIsInTime) {
  MissingAnswer missing(0.02);
  missing.expect(1, 5);
  missing.sent();
  missing.expect(2, 5.02);
  missing.sent();
  hear(missing, "ok 1");
  missing.other(1, 5.03);
  EXPECT_EQ(missing.text(), "its answer came after 30 ms, reply_timeout_s is 0.02");
  missing.expect(3, 5.04);
  missing.sent();
  EXPECT_EQ(missing.text(), "its answer came after 30 ms, reply_timeout_s is 0.02");
  missing.answered();
  missing.expect(4, 6);
  missing.sent();
  EXPECT_EQ(missing.text(), "nothing came back, messages sent: 1");
  missing.other(2, 6.01);  // an answer once more
  EXPECT_EQ(missing.text(), "it answered another message");
}

}  // namespace
}  // namespace microswarm::actuation
