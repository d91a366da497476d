// SPDX-License-Identifier: Apache-2.0
#include "microswarm/actuation/drivers/coil_link.hpp"

#include <boost/crc.hpp>
#include <cstddef>

namespace microswarm::actuation {
namespace {

constexpr std::uint8_t reply_bit = 0x80;
constexpr std::size_t longest_frame = 52;
constexpr std::size_t former_reply = 24, reply_size = 38;  // without the checksum
constexpr std::uint8_t emergency_bit = 0x80;

void append16(std::vector<std::uint8_t>& to, int value) {
  const auto bits = static_cast<std::uint16_t>(value);
  to.push_back(static_cast<std::uint8_t>(bits & 0xFF));
  to.push_back(static_cast<std::uint8_t>(bits >> 8));
}

void append(std::vector<std::uint8_t>& to, const CoilOutputs& outputs) {
  for (const int output : outputs) append16(to, output);
}

void append_frequency(std::vector<std::uint8_t>& to, const CoilAim& aim) {
  append16(to, aim.frequency);
  append16(to, aim.frequency >> 16);
}

int unsigned16(std::span<const std::uint8_t> bytes, std::size_t at) {
  return bytes[at] | bytes[at + 1] << 8;
}
int signed16(std::span<const std::uint8_t> bytes, std::size_t at) {
  return static_cast<std::int16_t>(unsigned16(bytes, at));
}

// Consistent overhead byte stuffing (Cheshire and Baker 1999): the only 0 is at the end.
std::vector<std::uint8_t> to_frame(std::vector<std::uint8_t> packet) {
  append16(packet, crc16(packet));
  std::vector<std::uint8_t> frame{0};
  std::size_t mark = 0;
  const auto close = [&] { frame[mark] = static_cast<std::uint8_t>(frame.size() - mark); };
  for (const std::uint8_t byte : packet) {
    if (byte != 0) {
      frame.push_back(byte);
      continue;
    }
    close();
    mark = frame.size();
    frame.push_back(0);
  }
  close();
  frame.push_back(0);
  return frame;
}

/// Whether the probe is of a channel, and its temperature within what a PT1000 is read for.
bool is_possible(const CoilReply& reply) {
  constexpr int least = -500, most = 2500;  // [0.1 °C]
  const int t = reply.temperature;
  const bool is_mark =
      t == coil_link_no_probe || t == coil_link_probe_shorted || t == coil_link_probe_open;
  return reply.probe < coil_link_channels && (is_mark || (t >= least && t <= most));
}

std::optional<CoilReply> parse_reply(std::span<const std::uint8_t> p) {
  if (p.size() < former_reply || !(p[0] & reply_bit)) return std::nullopt;
  const bool ours = p[2] == coil_link_version;
  if (p.size() != (ours ? reply_size : former_reply)) return std::nullopt;
  CoilReply reply{.to = CoilMessage{static_cast<std::uint8_t>(p[0] & ~reply_bit)},
                  .sequence = p[1],
                  .version = p[2],
                  .result = CoilResult{p[3]},
                  .state = CoilState{p[4]},
                  .limited = p[5],
                  .good = unsigned16(p, 6),
                  .bad = unsigned16(p, 8),
                  .trips = unsigned16(p, 10)};
  for (std::size_t c = 0; c < reply.outputs.size(); ++c) reply.outputs[c] = signed16(p, 12 + 2 * c);
  if (!ours) return reply;
  reply.clock = unsigned16(p, 24);
  reply.reset_cause = p[26];
  reply.trip = CoilTrip{static_cast<std::uint8_t>(p[27] & ~emergency_bit)};
  reply.emergency_open = p[27] & emergency_bit;
  reply.slew = p[28];
  reply.scale = unsigned16(p, 29);
  reply.aim_sum = unsigned16(p, 31);
  reply.phase = unsigned16(p, 33);
  reply.probe = p[35];
  reply.temperature = signed16(p, 36);
  if (!is_possible(reply)) return std::nullopt;
  return reply;
}

}  // namespace

std::uint16_t crc16(std::span<const std::uint8_t> bytes) {
  boost::crc_optimal<16, 0x1021, 0xFFFF> crc;
  crc.process_bytes(bytes.data(), bytes.size());
  return crc.checksum();
}

std::vector<std::uint8_t> encode(CoilMessage message, std::uint8_t sequence,
                                 std::span<const std::uint8_t> payload) {
  std::vector<std::uint8_t> packet{static_cast<std::uint8_t>(message), sequence};
  packet.insert(packet.end(), payload.begin(), payload.end());
  return to_frame(std::move(packet));
}

std::vector<std::uint8_t> encode_set(std::uint8_t sequence, int deadline,
                                     const CoilOutputs& outputs) {
  std::vector<std::uint8_t> payload;
  append16(payload, deadline);
  append(payload, outputs);
  return encode(CoilMessage::set, sequence, payload);
}

std::vector<std::uint8_t> encode_waveform(std::uint8_t sequence, int deadline, int phase,
                                          const CoilAim& aim) {
  std::vector<std::uint8_t> payload;
  append16(payload, deadline);
  append16(payload, phase);
  append_frequency(payload, aim);
  for (const CoilOutputs& part : {aim.constant, aim.cosine, aim.sine}) append(payload, part);
  return encode(CoilMessage::waveform, sequence, payload);
}

std::vector<std::uint8_t> encode_hello(std::uint8_t sequence) {
  const std::array<std::uint8_t, 1> payload{coil_link_version};
  return encode(CoilMessage::hello, sequence, payload);
}

std::vector<std::uint8_t> encode(const CoilReply& reply) {
  std::vector<std::uint8_t> packet{
      static_cast<std::uint8_t>(static_cast<std::uint8_t>(reply.to) | reply_bit),
      reply.sequence,
      static_cast<std::uint8_t>(reply.version),
      static_cast<std::uint8_t>(reply.result),
      static_cast<std::uint8_t>(reply.state),
      reply.limited};
  for (const int count : {reply.good, reply.bad, reply.trips}) append16(packet, count);
  append(packet, reply.outputs);
  if (reply.version == coil_link_version) {
    append16(packet, reply.clock);
    packet.push_back(static_cast<std::uint8_t>(reply.reset_cause));
    packet.push_back(static_cast<std::uint8_t>(static_cast<std::uint8_t>(reply.trip) |
                                               (reply.emergency_open ? emergency_bit : 0)));
    packet.push_back(static_cast<std::uint8_t>(reply.slew));
    for (const int value : {reply.scale, reply.aim_sum, reply.phase}) append16(packet, value);
    packet.push_back(reply.probe);
    append16(packet, reply.temperature);
  }
  return to_frame(std::move(packet));
}

CoilAim scaled(const CoilAim& aim, int scale) {
  CoilAim result = aim;
  for (CoilOutputs* part : {&result.constant, &result.cosine, &result.sine})
    for (int& output : *part) output = output * scale / coil_link_unscaled;
  return result;
}

std::uint16_t check_sum(const CoilAim& aim) {
  std::vector<std::uint8_t> bytes;
  append_frequency(bytes, aim);
  for (const CoilOutputs& part : {aim.constant, aim.cosine, aim.sine}) append(bytes, part);
  return crc16(bytes);
}

std::optional<std::vector<std::uint8_t>> decode(std::span<const std::uint8_t> frame) {
  std::vector<std::uint8_t> packet;
  for (std::size_t at = 0; at < frame.size();) {
    const std::size_t next = at + frame[at];
    if (next > frame.size()) return std::nullopt;
    packet.insert(packet.end(), frame.begin() + static_cast<std::ptrdiff_t>(at) + 1,
                  frame.begin() + static_cast<std::ptrdiff_t>(next));
    if (next < frame.size()) packet.push_back(0);
    at = next;
  }
  if (packet.size() < 4) return std::nullopt;
  const std::size_t size = packet.size() - 2;
  if (crc16(std::span(packet).first(size)) != unsigned16(packet, size)) return std::nullopt;
  packet.resize(size);
  return packet;
}

std::optional<CoilReply> CoilReplyReader::take(std::uint8_t byte) {
  if (byte != 0) {
    if (frame_.size() <= longest_frame) frame_.push_back(byte);
    return std::nullopt;
  }
  if (frame_.empty()) return std::nullopt;
  std::optional<CoilReply> reply;
  if (frame_.size() <= longest_frame)
    if (const auto packet = decode(frame_)) reply = parse_reply(*packet);
  if (!reply) ++bad_;
  frame_.clear();
  return reply;
}

}  // namespace microswarm::actuation
