// SPDX-License-Identifier: Apache-2.0
#include "lab/stream/request.hpp"

#include <fmt/format.h>

#include "microswarm/config/json.hpp"
#include "microswarm/core/errors/error.hpp"

namespace microswarm::lab {
namespace {

/// An object with a list of texts or numbers.
constexpr JsonLimits limits{.bytes = max_request_size, .depth = 2};

/// Reads a message. Throws an InputError of its first mistake.
template <class Message>
Message read_message(std::string_view text) {
  Message message;
  Issues issues;
  read_json(message, text, "message", issues, limits);
  if (!issues.empty()) throw InputError(*issues.begin());
  if (message.settings.size() > max_settings)
    throw InputError(fmt::format("message: {} settings, at most {} are allowed",
                                 message.settings.size(), max_settings));
  return message;
}

}  // namespace

Request read_request(std::string_view text) { return read_message<Request>(text); }

std::uint64_t id_in(std::string_view text) {
  Request request;
  try {
    Issues mistakes;
    read_json(request, text, "message", mistakes, limits);
  } catch (const InputError&) {
    return 0;
  }
  return request.id;
}

OpenRequest read_open_request(std::string_view text) {
  OpenRequest request = read_message<OpenRequest>(text);
  if (request.photo.has_value() != (request.um_per_px > 0))
    throw InputError("message: photo and um_per_px go together");
  return request;
}

PhotoRequest read_photo_request(std::string_view text) { return read_message<PhotoRequest>(text); }

}  // namespace microswarm::lab
