// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <string>

namespace microswarm::lab {

/// One message to a page: a CBOR map whose key `type` names it; docs/reference/lab-protocol.md
/// lists them. Positions are byte strings of little-endian floats, alternating x and y [µm].
struct Message {
  enum class Kind { hello, frame, standing, picture, rig, answer, other };
  std::string bytes;
  Kind kind = Kind::other;
  /// Whether a newer message of its kind supersedes this one.
  bool is_latest_only() const {
    return kind == Kind::frame || kind == Kind::standing || kind == Kind::picture ||
           kind == Kind::rig;
  }
};
using MessagePtr = std::shared_ptr<const Message>;

/// Encodes a message in CBOR.
MessagePtr make_message(const nlohmann::json& json, Message::Kind kind = Message::Kind::other);

}  // namespace microswarm::lab
