// SPDX-License-Identifier: Apache-2.0
#include "microswarm/actuation/drivers/coil_link.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string_view>

#include "microswarm/core/maths/rng.hpp"

namespace microswarm::actuation {
namespace {

CoilReply some_reply(Rng& rng) {
  CoilReply reply{.to = CoilMessage::set,
                  .sequence = static_cast<std::uint8_t>(rng.below(256)),
                  .version = coil_link_version,
                  .result = CoilResult::limited,
                  .state = CoilState::armed,
                  .limited = 0x21,
                  .good = static_cast<int>(rng.below(65536)),
                  .bad = static_cast<int>(rng.below(3)),
                  .trips = 0,
                  .clock = static_cast<int>(rng.below(65536)),
                  .reset_cause = static_cast<int>(rng.below(16)),
                  .trip = CoilTrip::emergency,
                  .emergency_open = rng.below(2) == 1,
                  .slew = 100,
                  .scale = static_cast<int>(rng.below(32769)),
                  .aim_sum = static_cast<int>(rng.below(65536)),
                  .phase = static_cast<int>(rng.below(65536)),
                  .probe = static_cast<std::uint8_t>(rng.below(coil_link_channels)),
                  .temperature = static_cast<int>(rng.below(3001)) - 500};
  for (int& output : reply.outputs) output = static_cast<int>(rng.below(2001)) - 1000;
  return reply;
}

std::vector<CoilReply> replies_in(CoilReplyReader& reader, std::span<const std::uint8_t> bytes) {
  std::vector<CoilReply> replies;
  for (const std::uint8_t byte : bytes)
    if (const auto reply = reader.take(byte)) replies.push_back(*reply);
  return replies;
}

bool same(const CoilReply& a, const CoilReply& b) { return encode(a) == encode(b); }

TEST(CoilLink, CheckSumIsTheKnownOne) {
  constexpr std::string_view digits = "123456789";
  const std::vector<std::uint8_t> bytes(digits.begin(), digits.end());
  EXPECT_EQ(crc16(bytes), 0x29B1);
}

TEST(CoilLink, TheBytesOnTheWireArePinned) {
  using Bytes = std::vector<std::uint8_t>;
  EXPECT_EQ(encode_hello(7), (Bytes{6, 1, 7, 3, 0x58, 0x52, 0}));
  EXPECT_EQ(encode_set(200, 0x1234, {0, 1000, -1000, 1, 256, -2}),
            (Bytes{0x5,  0x3, 0xc8, 0x34, 0x12, 0x1,  0x6,  0xe8, 0x3,  0x18,
                   0xfc, 0x1, 0x1,  0x6,  0x1,  0xfe, 0xff, 0xe9, 0x2b, 0x0}));
  EXPECT_EQ(
      encode_waveform(201, 0x1234, 16384, {.frequency = -70000, .constant = {5}, .sine = {0, -7}}),
      (Bytes{0x5, 0x6, 0xc9, 0x34, 0x12, 0x7, 0x40, 0x90, 0xee, 0xfe, 0xff, 0x5,  0x1,
             0x1, 0x1, 0x1,  0x1,  0x1,  0x1, 0x1,  0x1,  0x1,  0x1,  0x1,  0x1,  0x1,
             0x1, 0x1, 0x1,  0x1,  0x1,  0x1, 0x1,  0x1,  0x1,  0x1,  0x3,  0xf9, 0xff,
             0x1, 0x1, 0x1,  0x1,  0x1,  0x1, 0x1,  0x3,  0xa5, 0x8,  0x0}));
}

TEST(CoilLink, FramesEndWithTheirOnlyZero) {
  Rng rng(1, Purpose::test);
  for (int k = 0; k < 500; ++k) {
    std::array<int, coil_link_channels> outputs{};
    for (int& output : outputs)
      output = rng.below(2) ? 0 : static_cast<int>(rng.below(2001)) - 1000;
    const auto frame = encode_set(static_cast<std::uint8_t>(k), 257, outputs);
    EXPECT_EQ(std::count(frame.begin(), frame.end(), 0), 1);
    EXPECT_EQ(frame.back(), 0);
    EXPECT_EQ(frame.size(), 20u);
  }
}

TEST(CoilLink, RepliesComeBackAsTheyWere) {
  Rng rng(2, Purpose::test);
  CoilReplyReader reader;
  for (int k = 0; k < 500; ++k) {
    const CoilReply reply = some_reply(rng);
    const auto read = replies_in(reader, encode(reply));
    ASSERT_EQ(read.size(), 1u);
    EXPECT_TRUE(same(read[0], reply));
    EXPECT_EQ(read[0].outputs, reply.outputs);
    EXPECT_EQ(read[0].probe, reply.probe);
    EXPECT_EQ(read[0].temperature, reply.temperature);
  }
  EXPECT_EQ(reader.bad(), 0);
}

TEST(CoilLink, ATemperatureIsOfAChannelAndPossible) {
  Rng rng(6, Purpose::test);
  CoilReply reply = some_reply(rng);
  const auto is_read = [&](std::uint8_t probe, int temperature) {
    reply.probe = probe;
    reply.temperature = temperature;
    CoilReplyReader reader;
    return !replies_in(reader, encode(reply)).empty();
  };
  for (const int mark : {coil_link_no_probe, coil_link_probe_open, coil_link_probe_shorted})
    EXPECT_TRUE(is_read(5, mark));
  EXPECT_TRUE(is_read(0, -500));
  EXPECT_TRUE(is_read(0, 2500));
  EXPECT_FALSE(is_read(6, 200));
  EXPECT_FALSE(is_read(0, -501));
  EXPECT_FALSE(is_read(0, 2501));
}

// Whatever version a device has, its answer to a hello says so.
TEST(CoilLink, RepliesOfOtherVersionsBeginAlike) {
  Rng rng(5, Purpose::test);
  CoilReply reply = some_reply(rng);
  for (const int version : {1, 2}) {
    reply.version = version;
    CoilReplyReader reader;
    const auto read = replies_in(reader, encode(reply));
    ASSERT_EQ(read.size(), 1u);
    EXPECT_EQ(read[0].version, version);
    EXPECT_EQ(read[0].outputs, reply.outputs);
    EXPECT_EQ(read[0].clock, 0);
  }
}

TEST(CoilLink, NoFlippedBitIsTakenForAReply) {
  Rng rng(3, Purpose::test);
  const auto frame = encode(some_reply(rng));
  for (std::size_t k = 0; k + 1 < frame.size(); ++k)
    for (unsigned bit = 0; bit < 8; ++bit) {
      auto bytes = frame;
      bytes[k] = static_cast<std::uint8_t>(bytes[k] ^ (1u << bit));
      CoilReplyReader reader;
      EXPECT_TRUE(replies_in(reader, bytes).empty()) << k << ", " << bit;
    }
}

TEST(CoilLink, GarbageBeforeAReplyCostsThatReplyAtMost) {
  Rng rng(4, Purpose::test);
  const CoilReply reply = some_reply(rng);
  const auto frame = encode(reply);
  CoilReplyReader reader;
  for (int k = 0; k < 300; ++k) {
    std::vector<std::uint8_t> bytes;
    for (std::uint64_t n = rng.below(100); n > 0; --n)
      bytes.push_back(static_cast<std::uint8_t>(rng.below(256)));
    bytes.insert(bytes.end(), frame.begin(), frame.end());
    bytes.insert(bytes.end(), frame.begin(), frame.end());
    const auto read = replies_in(reader, bytes);
    ASSERT_FALSE(read.empty());
    EXPECT_TRUE(same(read.back(), reply));
  }
}

}  // namespace
}  // namespace microswarm::actuation
